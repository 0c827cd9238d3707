"""A job's run to its end, with everything that is judged."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.failure import InvalidInput, SimulationFailed
from jointplay.records.peak import Peak
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.runs.certificate.certificate import Certificate
from jointplay.solver.runs.simulate import Simulation

Floats = NDArray[np.float64]
Onsets = dict[int, Floats]
"""Ascending times, s, at which contacts begin, by index of their pair."""

MOST_STEPS = 400_000
"""A run that takes more is not judged."""


@dataclass(frozen=True)
class Finished:
    """A run at its end; `samples` is (count, channels) at `time`, s."""

    admission: Admission
    method: str
    """That it was computed with in the end."""
    one_method: bool
    """Whether it had that from its start, so that a run with one method repeats it."""
    scene: dict[str, Any]
    names: list[str]
    units: list[str]
    time: Floats
    samples: Floats
    peaks: dict[str, Peak]
    onsets: Onsets
    certificate: Certificate | None


def finish(job: dict[str, Any], most_steps: float = MOST_STEPS) -> Finished | str:
    """Run a job to its end, or return how it failed."""
    try:
        admission = admit(job)
    except InvalidInput as refused:
        return f"refused: {refused}"
    assert isinstance(admission, Admission)
    simulation = Simulation(admission)
    times, samples, impacts, methods = [], [], [], set[float]()
    try:
        for piece in simulation.slices():
            times.append(piece.sample_time)
            samples.append(piece.samples)
            impacts.append(piece.impacts)
            methods.update(piece.steps[:, -1].tolist())
            if simulation.summary().statistics["steps"] > most_steps:
                return "too many steps"
    except SimulationFailed as failure:
        return failure.code
    summary = simulation.summary()
    return Finished(
        admission,
        summary.statistics["method"],
        len(methods) <= 1,
        admission.scene_document(),
        [channel.name for channel in admission.channels],
        [channel.unit for channel in admission.channels],
        np.concatenate(times),
        np.concatenate(samples),
        summary.peaks,
        _onsets(np.concatenate(impacts)),
        simulation.certificate(),
    )


def _onsets(impacts: NDArray[np.void]) -> Onsets:
    joint, onset = impacts["joint"], impacts["onset"]
    return {int(pair): np.sort(onset[joint == pair]) for pair in np.unique(joint)}
