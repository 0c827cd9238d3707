"""Runs of a job to its end, kept, so that tests of different things share one computation."""

import json
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.impact import IMPACT
from jointplay.records.peak import Peak
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.runs.results import Slice
from jointplay.solver.runs.simulate import Simulation

Floats = NDArray[np.float64]

CASE_3 = {
    "stiffness": 5e9,
    "restitution": 0.7,
    "bearing_radius": 0.01,
    "static_velocity": 1e-3,
    "dynamic_velocity": 1e-2,
    "clearance": 5e-4,
    "friction": 0.1,
}
"""The press of the requirement's third case; its second has friction 0.01 and other clearances."""


@dataclass(frozen=True)
class Run:
    """Everything that a job gave."""

    admission: Admission
    time: Floats
    samples: dict[str, Floats]
    section_time: Floats
    sections: dict[str, Floats]
    impacts: NDArray[np.void]
    peaks: dict[str, Peak]
    statistics: dict[str, Any]

    def __getitem__(self, channel: str) -> Floats:
        return self.samples[channel]

    def last(self, *channels: str) -> Floats:
        """Return channels at the end of the run."""
        return np.array([self.samples[channel][-1] for channel in channels])

    def contacts(self, joint: str) -> NDArray[np.void]:
        """Return the contacts of one joint, in the order of their onset."""
        index = self.admission.joints.index(joint)
        found = self.impacts[self.impacts["joint"] == index]
        return found[np.argsort(found["onset"])]


def collect(admission: Admission, slices: list[Slice], simulation: Simulation) -> Run:
    """Put slices together."""
    names = [channel.name for channel in admission.channels]

    def columns(blocks: list[Floats]) -> dict[str, Floats]:
        table = np.concatenate([np.empty((0, len(names))), *blocks])
        return dict(zip(names, table.T, strict=True))

    summary = simulation.summary()
    return Run(
        admission,
        np.concatenate([np.empty(0), *(s.sample_time for s in slices)]),
        columns([s.samples for s in slices]),
        np.concatenate([np.empty(0), *(s.section_time for s in slices)]),
        columns([s.sections for s in slices]),
        np.concatenate([np.empty(0, dtype=IMPACT), *(s.impacts for s in slices)]),
        summary.peaks,
        summary.statistics,
    )


def run(scene: str | dict[str, Any], duration: float, **job: Any) -> Run:
    """Run a preset by name, or a whole scene document; parameters by the keyword `parameters`.

    Without a certificate, unless asked for.
    """
    parameters = job.pop("parameters", {})
    document = {
        "kind": "simulate",
        "scene": {"preset": scene, "parameters": parameters} if isinstance(scene, str) else scene,
        "duration": duration,
        "certificate": False,
        **job,
    }
    return _run(json.dumps(document))


@cache
def _run(text: str) -> Run:
    admission = admit(json.loads(text))
    simulation = Simulation(admission)
    return collect(admission, list(simulation.slices()), simulation)
