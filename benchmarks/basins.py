"""Shares of starts by the attractor that they end on, beside what is known of them.

What is known is published for 1e4 drawn starts, or counted by an independent program on a grid of
starts, which errs by a few of the points beside the boundary: Runge-Kutta 4 in small steps
(pendulum 1e6 starts, Duffing and three magnets 4e4), the belt's friction with its jump (6e4
starts), Newton's law of impact with the closed-form flow (1e4 starts). The published share of the
belt is 0.312 +- 0.007.
"""

import argparse
import math
import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from benchmarks.basin_scenes import belt, duffing, impact_oscillator, magnets, pendulum
from jointplay.local import run
from jointplay.records.attractors import Attractor, attractors_of


@dataclass(frozen=True)
class Anchor:
    """A mechanism, the box of its starts, and its shares by the names of attractors."""

    name: str
    scene: dict[str, Any]
    starts: Mapping[str, tuple[float, float]]
    fields: Mapping[str, Any]
    shares: Mapping[str, float]
    of_grid: float
    """Error of the shares."""

    def job(self, samples: int, seed: int = 1) -> dict[str, Any]:
        """Return the job that draws starts."""
        return {
            "kind": "basin-stability",
            "scene": self.scene,
            "starts": {
                start: {"distribution": "uniform", "low": low, "high": high}
                for start, (low, high) in self.starts.items()
            },
            "samples": samples,
            "seed": seed,
            "tolerance": 1e-6,
            "indicators": ["recurrence"],
            **self.fields,
        }

    def compared(self, found: tuple[Attractor, ...]) -> dict[str, tuple[float, float]]:
        """Return share and standard errors apart by name; of what is not known 0 is known.

        Attractors of one kind have letters in the order in which they are met: they are compared
        in that of their shares.
        """
        known = sorted(self.shares.items(), key=_kind_and_share)
        seen = sorted(((one.name, one.share) for one in found), key=_kind_and_share)
        ended = sum(one.points for one in found)
        kinds = {_kind(name): 0 for name, _ in known + seen}
        answer = {}
        for kind in kinds:
            exact = [item for item in known if _kind(item[0]) == kind]
            own = [share for name, share in seen if _kind(name) == kind]
            exact += [(f"{kind}?", 0.0)] * (len(own) - len(exact))
            own += [0.0] * (len(exact) - len(own))
            for k, ((name, share), value) in enumerate(zip(exact, own, strict=True)):
                label = name if share else f"{name}{k}"
                spread = math.sqrt(max(share * (1.0 - share), 1.0 / ended) / ended)
                answer[label] = value, (value - share) / math.hypot(spread, self.of_grid)
        return answer


def _kind(name: str) -> str:
    return name.partition(" ")[0]


def _kind_and_share(item: tuple[str, float]) -> tuple[str, float]:
    return _kind(item[0]), -item[1]


SLIDE = {"/start/points/mass.centre/0": (-1.0, 1.0), "/start/velocities/mass/0": (-0.5, 1.0)}
ANCHORS = (
    Anchor(
        "pushed pendulum",
        pendulum(),
        {
            "/start/angles/rod": (math.asin(0.5) - math.pi, math.asin(0.5) + math.pi),
            "/start/angular_velocities/rod": (-10.0, 10.0),
        },
        {"section": {"channel": "rod.theta", "value": math.pi}, "settle": 20, "record": 6},
        {"equilibrium": 0.15260, "period-1": 0.84740},
        2e-4,
    ),
    Anchor(
        "Duffing",
        duffing(),
        SLIDE,
        {"settle": 150, "record": 12},
        {
            "period-1 large": 0.4993,
            "period-1 small": 0.1974,
            "period-2": 0.0275,
            "period-2 mirrored": 0.0267,
            "period-3": 0.2491,
        },
        1e-3,
    ),
    Anchor(
        "oscillator on a belt",
        belt(),
        {"/start/points/mass.centre/0": (-2.0, 2.0), "/start/velocities/mass/0": (0.0, 2.0)},
        {"section": {"channel": "mass.vx", "value": 0.0}, "settle": 110, "record": 6},
        {"equilibrium": 0.30715, "period-1": 0.69285},
        1e-3,
    ),
    Anchor(
        "three magnets",
        magnets(),
        {f"/start/points/bob.centre/{k}": (-2.0, 2.0) for k in range(2)},
        {"settle": 22, "record": 4},
        {"equilibrium a": 0.33338, "equilibrium b": 0.33338, "equilibrium c": 0.33325},
        1e-3,
    ),
    Anchor(
        "impact oscillator",
        impact_oscillator(),
        {
            "/start/joints/stop/eccentricity/0": (0.17, 0.2),
            "/start/joints/stop/rate/0": (-0.5, 0.5),
        },
        {"settle": 150, "record": 8},
        {"period-1 impacting": 0.733, "period-1 quiet": 0.267},
        0.005,
    ),
)


def main() -> None:
    """Print the shares of each mechanism, and what is known."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--samples", type=int, default=4000)
    given = parser.parse_args()
    print(f"{'':22}{'attractor':22}{'known':>8}{'found':>8}{'apart, errors':>15}{'core-s':>8}")
    for anchor in ANCHORS:
        begun = time.process_time()
        study = run(anchor.job(given.samples), processes=1).study()
        took = time.process_time() - begun
        name, seconds = anchor.name, f"{took:8.1f}"
        for label, (share, apart) in anchor.compared(attractors_of(study).found).items():
            known = anchor.shares.get(label, 0.0)
            print(f"{name:22}{label:22}{known:8.4f}{share:8.4f}{apart:15.1f}{seconds}")
            name = seconds = ""


if __name__ == "__main__":
    main()
