"""Share of a run's true error that its certificate covers, where finer runs give that error."""

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from jointplay.records.certificate import converged
from jointplay.records.failure import SimulationFailed
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.runs.certificate.certificate import Certificate
from jointplay.solver.runs.simulate import Simulation
from jointplay.worker.certificates import record_of

Floats = NDArray[np.float64]

REFERENCE, COARSER = 1e-12, 4e-12
"""Tolerances of two references: where they differ by more than DOUBT of what is to be judged, no
truth is known."""
FINER = 1e-2
"""A reference has at most this share of the tolerance of what it judges."""
DOUBT = 0.1
ROUNDING = 1e-10
"""Error of a value: what a reference itself is off by, which for a constant is all there is."""
PATIENCE = 20.0
"""Seconds of computing that a run may take."""


class Coverage(NamedTuple):
    """Coverage of the errors of a run, over channels and instants at which it is converged."""

    covered: float
    """Share of those whose truth is known that the estimate covers; NaN: none is known."""
    known: float
    """Share of which the truth is known."""
    converged: float
    """Share of the instants."""
    ratio: float
    """Median of estimate by true error, where there is an error."""


def coverage_of(job: dict[str, Any]) -> Coverage | None:
    """Compare the estimated errors of a job with the true ones, at the certificate's instants.

    None where nothing tells them: for the finest tolerances, where a motion is prescribed, and
    where a run fails or takes more than PATIENCE.
    """
    if FINER * job["tolerance"] < REFERENCE:
        return None
    try:
        certificate = _run(job | {"certificate": True})[1]
    except SimulationFailed:
        return None
    assert certificate is not None
    time = certificate.time
    if not len(time):
        return None
    within = converged(record_of(certificate), time)
    step = float(time[1])
    index = np.round(time[within] / step).astype(int)
    plain = job | {"certificate": False, "output_step": step}
    if not index[-1]:
        return Coverage(np.nan, 0.0, float(within.mean()), np.nan)
    until = plain | {"duration": float(time[within][-1])}  # further on nothing is claimed
    try:
        values, truth, coarser = (
            _run(finer, int(index[-1]) + 1)[0][index]
            for finer in (
                plain,
                until | {"tolerance": REFERENCE},
                until | {"tolerance": COARSER},
            )
        )
    except SimulationFailed:
        return None
    error, doubt = np.abs(values - truth), np.abs(truth - coarser)
    estimate, rounding = certificate.error[within], ROUNDING * np.abs(truth)
    known = doubt <= DOUBT * np.maximum(estimate, error) + rounding
    covered = error <= estimate + rounding
    usable = known & (error > rounding) & (error > 0.0)
    return Coverage(
        float(covered[known].mean()) if known.any() else np.nan,
        float(known.mean()),
        float(within.mean()),
        float(np.median(estimate[usable] / error[usable])) if usable.any() else np.nan,
    )


def _run(job: dict[str, Any], enough: float = math.inf) -> tuple[Floats, Certificate | None]:
    """Return samples, (samples, channels), of a run until there are enough; its certificate."""
    admission = admit(job)
    assert isinstance(admission, Admission)
    simulation = Simulation(admission)
    pieces, count = [], 0
    for piece in simulation.slices(PATIENCE):
        pieces.append(piece.samples)
        count += len(piece.samples)
        if count >= enough:
            break
    return np.concatenate(pieces), simulation.certificate()
