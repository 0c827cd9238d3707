"""A case at an end of a range, and what becomes of it."""

import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from jointplay.records.failure import InvalidInput, SimulationFailed
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.runs.simulate import Simulation

JOURNAL, CRANK, PRESS = "bouncing-journal", "slider-crank", "seven-bar-press"
THROWN = {"velocity_x": 0.1, "spin": 30.0}
"""A journal that bounces and rubs."""
STANDARD = 1e-6
ROUNDING = 1e-12
"""Smaller tolerances are not reached: positions of a metre are rounded at 1e-16 m, and what that
does times a contact force of a kilonewton is more."""
PATIENCE = 600.0
"""Seconds of computing."""


@dataclass(frozen=True)
class Case:
    """A job at an end of a range; `long` where it takes more than a second."""

    family: str
    name: str
    scene: str | dict[str, Any]
    duration: float
    parameters: Mapping[str, Any] = field(default_factory=dict)
    tolerance: float = STANDARD
    output_step: float | None = None
    long: bool = False

    @property
    def id(self) -> str:
        """Name of the case among all."""
        return f"{self.family}: {self.name}"

    @property
    def job(self) -> dict[str, Any]:
        """The job document."""
        scene = self.scene
        if isinstance(scene, str):
            scene = {"preset": scene, "parameters": dict(self.parameters)}
        return {
            "kind": "simulate",
            "scene": scene,
            "duration": self.duration,
            "tolerance": self.tolerance,
            "output_step": self.output_step,
            "certificate": False,
        }


@dataclass(frozen=True)
class Outcome:
    """End of a case.

    Attributes
    ----------
    ended : str
        ``done``, ``refused``, or the code of the failure.
    detail : str
        What to change, where it is not done.
    reached : float
        Simulated time, s.
    finite : bool
        Whether all samples are.
    closure : float
        |energy residual| / (tolerance * gross work).
    """

    ended: str
    detail: str = ""
    reached: float = 0.0
    finite: bool = True
    steps: int = 0
    onsets: int = 0
    closure: float = 0.0
    seconds: float = 0.0


def outcome_of(case: Case) -> Outcome:
    """Run a case to its end, whatever that is."""
    try:
        admission = admit(case.job)
    except InvalidInput as refused:
        return Outcome("refused", str(refused))
    assert isinstance(admission, Admission)
    simulation = Simulation(admission)
    ended, detail, reached, finite = "done", "", 0.0, True
    begun = time.perf_counter()
    try:
        for piece in simulation.slices(PATIENCE):
            reached = piece.time
            finite &= bool(np.isfinite(piece.samples).all())
    except SimulationFailed as failure:
        ended, detail = failure.code, failure.detail
    statistics = simulation.summary().statistics
    energy, closure = statistics["energy"], 0.0
    if energy is not None and energy["gross_work"] > 0.0:
        allowed = max(case.tolerance, ROUNDING) * energy["gross_work"]
        closure = abs(energy["residual"]) / allowed
    return Outcome(
        ended,
        detail,
        reached,
        finite,
        statistics["steps"],
        statistics["onsets"],
        closure,
        time.perf_counter() - begun,
    )
