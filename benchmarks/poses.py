"""Poses a second of a mechanism that is dragged: a point goes round, each pose begins at the last.

    python -m benchmarks poses

The client asks as the page does, one pose after the other. Processor time is that of the service.
"""

import os
import statistics
import tempfile
import time
from math import cos, pi, sin
from pathlib import Path
from typing import Any, Final, NamedTuple

from jointplay.client import Client
from jointplay.service.processes import running_service
from tests.waiting import processor_time

PULLED: Final = {"four-bar": "crank.B", "jansen-leg": "crank.P", "seven-bar-press": "crank4.pin"}
POSES, FIRST = 150, 10
"""Poses of one turn; the first ones are not counted: a process starts."""
SHARE: Final = 0.1
"""Radius of the circle, as a share of the mechanism's largest coordinate."""


class Dragged(NamedTuple):
    """Seconds of each pose, and of the service's processor in all."""

    waits: list[float]
    spent: float


def point_at(points: dict[str, Any], point: str, pose: dict[str, list[float]]) -> list[float]:
    """Return where a point of a body is."""
    body, _, name = point.partition(".")
    (x, y, theta), (along, across) = pose[body], points[body]["points"][name]
    return [
        x + cos(theta) * along - sin(theta) * across,
        y + sin(theta) * along + cos(theta) * across,
    ]


def dragged(client: Client, preset: str, point: str) -> Dragged:
    """Drag a point round a circle."""
    pose = client.poses(preset)["poses"][0]
    begin = point_at(client.scene(preset)["bodies"], point, pose)
    radius = SHARE * max(abs(one) for at in pose.values() for one in at[:2])
    waits, spent = list[float](), 0.0
    for number in range(FIRST + POSES):
        if number == FIRST:
            waits, spent = [], processor_time()
        angle = 2.0 * pi * number / POSES
        position = [begin[0] + radius * (cos(angle) - 1.0), begin[1] + radius * sin(angle)]
        asked = time.perf_counter()
        pose = client.drag(preset, point, position, pose=pose)
        waits.append(time.perf_counter() - asked)
    return Dragged(waits, processor_time() - spent)


def main() -> None:
    """Print a line for each mechanism."""
    with (
        tempfile.TemporaryDirectory() as made,
        running_service(Path(made), 0) as url,
        Client(url) as client,
    ):
        for preset, point in PULLED.items():
            found = dragged(client, preset, point)
            print(
                f"{preset:<16}{POSES / sum(found.waits):8.1f} poses/s, median"
                f" {1e3 * statistics.median(found.waits):.1f} ms, of the service's processor"
                f" {1e3 * found.spent / POSES:.1f} ms; load {os.getloadavg()[0]:.1f}"
            )


if __name__ == "__main__":
    main()
