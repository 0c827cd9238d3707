"""Followers without play that their cams pull: an ideal one is held both ways, and says so."""

from collections.abc import Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.peak import Peak
from jointplay.solver.kernels.loop.runs import SAMPLES
from jointplay.solver.kernels.trace.rows import Rows
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.runs.certificate.certificate import Certificate
from jointplay.solver.runs.lane_results import peaks_of
from jointplay.solver.scene.document import Scene

ROUNDING = 1e-9
"""Share of the largest push up to which a pull is none."""


class Pulled(NamedTuple):
    """An ideal follower that is pulled: since when, how hard at most, and when that is."""

    joint: str
    first: float
    largest: float
    time: float
    detail: str


def followers(scene: Scene) -> list[str]:
    """Return the ideal followers of a scene."""
    return [name for name, joint in scene.joints.items() if joint.one_sided and not joint.has_play]


def force_of(name: str) -> str:
    """Return the channel of the force on an ideal follower."""
    return f"{name}.normal_force"


class Followers:
    """The ideal followers of a run that is integrated: when each is pulled first, at a sample."""

    def __init__(self, scene: Scene, rows: Rows) -> None:
        self.names = followers(scene)
        self.columns = np.array([rows.index(force_of(name)) for name in self.names], np.int64)
        self.first: dict[str, list[list[float]]] = {}
        """As `first_pulls` has it, by joint."""

    def examine(self, bundle: Bundle, lane: int, times: Floats) -> None:
        """Look at the samples that a lane hands out, at their times, s."""
        if self.names and len(times):
            values = bundle.observe(lane, bundle.rows(SAMPLES, lane), self.columns)
            pushes = dict(zip(self.names, values.T, strict=True))
            for name, push in pushes.items():
                self.first[name] = first_pulls(times, push, self.first.get(name, []))

    def pulled(self, bundle: Bundle, lane: int) -> list[Pulled]:
        """Return those that were pulled, by the extremes of a lane."""
        peaks = peaks_of(bundle, lane, [force_of(name) for name in self.names])
        return pulled({name: peaks[force_of(name)] for name in self.names}, self.first)


def first_pulls(times: Floats, push: Floats, before: list[list[float]]) -> list[list[float]]:
    """Return when a follower is first pulled ten times as hard as before, (time, push), s and N.

    Which of these are rounding, its largest push tells in the end. `before` : of earlier times.
    """
    found = list(before)
    while (harder := push < (10.0 * found[-1][1] if found else 0.0)).any():
        k = int(harder.argmax())
        found.append([float(times[k]), float(push[k])])
    return found


def pulled(peaks: Mapping[str, Peak], first: Mapping[str, list[list[float]]]) -> list[Pulled]:
    """Return the followers that are pulled; `peaks` of their forces by joint, see `first_pulls`."""
    found = []
    for name, peak in peaks.items():
        least = -ROUNDING * max(peak.maximum, -peak.minimum)
        if peak.minimum < least:
            begun = [time for time, push in first.get(name, []) if push < least]
            since = min([*begun, peak.minimum_time])
            detail = (
                f"The ideal follower '{name}' is pulled from {since:.6g} s on, by"
                f" {-peak.minimum:.3g} N at most, at {peak.minimum_time:.6g} s, where a real one"
                " lifts off: give it a lash, or press it on by a stiffer spring."
            )
            found.append(Pulled(name, since, -peak.minimum, peak.minimum_time, detail))
    return found


def with_pulls(certificate: Certificate, found: list[Pulled]) -> Certificate:
    """Return a certificate that names the followers that are pulled."""
    note = " ".join(filter(None, (certificate.facts["note"], *(one.detail for one in found))))
    facts = {"note": note, "pulling": [one._asdict() for one in found]}
    return replace(certificate, facts=certificate.facts | facts)
