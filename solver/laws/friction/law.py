"""Interface of friction laws."""

import math
from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.quantities.units import Rule, Strict


@dataclass(frozen=True)
class InnerState:
    """A state of a law's own, integrated with the motion; in a scene's channels by its name."""

    name: str
    unit: str
    long_name: str
    scale: float
    """Scale that the tolerance of a step's error is relative to."""
    start: float = 0.0


class FrictionLaw(Strict):
    """The force along the tangent where a journal touches its bearing.

    Slip is the velocity of the journal's surface against the bearing's along the tangent, m/s; the
    force on the journal opposes it. The force must vanish with the normal force, and the rates of
    inner states must not jump where a contact begins or ends: inner states go on while apart.
    """

    law: str
    rules: ClassVar[tuple[Rule, ...]] = ()
    """Rules that the parameters must keep."""

    @abstractmethod
    def friction_force(self, normal_force: Scalar, slip: Scalar, inner: Sequence[Scalar]) -> Scalar:
        """Return the force on the journal along the tangent, N."""

    @property
    def inner_states(self) -> tuple[InnerState, ...]:
        """States of the law's own; their number must not depend on parameters."""
        return ()

    def inner_rates(
        self, normal_force: Scalar, slip: Scalar, inner: Sequence[Scalar]
    ) -> Sequence[Scalar]:
        """Return the rate of change of each inner state, its unit a second."""
        return ()

    @property
    def is_off(self) -> bool:
        """True if there is no friction at all, so that nothing is computed."""
        return False

    @property
    def full_slip_speed(self) -> float:
        """Slip speed at which friction is full, m/s: the error of a speed in a step stays below."""
        return math.inf

    @property
    def bends(self) -> tuple[float, float]:
        """Two slip speeds at which friction bends or jumps, m/s, infinite where there is none.

        Extremes are sought between them, and may be missed beside others.
        """
        return self.full_slip_speed, math.inf

    @property
    def slips_with_material(self) -> bool:
        """True if rotation counts in the slip; else it is that of the press paper's eqs 5-7."""
        return True

    @property
    def tangent_obstacle(self) -> str:
        """Reason why no tangent vector follows a run with this law, with the remedy, or nothing."""
        return ""
