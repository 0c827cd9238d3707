"""Drivers of a scene: what prescribes the motion of a joint, or of a body's angle."""

from abc import abstractmethod
from typing import Annotated, Any

from jointplay.solver.laws.function import Derivatives
from jointplay.solver.laws.function.uses import Prescribed
from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.quantities.units import (
    Name,
    Strict,
    quantity,
)
from jointplay.solver.scene.unions import discriminated_by, form, has


class Driver(Strict):
    """Prescribed motion of an ideal joint, or of a body's angle whatever its joints.

    For a revolute joint the position is the journal body's angle less the bearing body's (rad,
    rad/s), for a prismatic joint the slider's displacement along the axis (m, m/s), for a
    body its angle against the ground, from where the torque acts.

    Its clock is what its motion is a function of: it starts at `clock_start` and goes at
    `clock_rate` a second.
    """

    joint: Name | None = None
    body: Name | None = None
    position: Annotated[float, quantity("rad or m", ge=-1e4, le=1e4)] = 0.0

    @abstractmethod
    def at(self, clock: Scalar) -> Derivatives:
        """Return position, speed and acceleration, in rad or m and seconds."""

    @property
    @abstractmethod
    def clock_start(self) -> Scalar:
        """Reading of the clock at the start."""

    @property
    @abstractmethod
    def clock_rate(self) -> Scalar:
        """Gain of the clock in a second."""


class SteadyDriver(Driver):
    """Prescribed motion at constant speed, position + speed * t; its clock shows the position."""

    speed: Annotated[float, quantity("rad/s or m/s", ge=-1e5, le=1e5)]

    def at(self, clock: Scalar) -> Derivatives:
        """See `Driver.at`."""
        return Derivatives(clock, self.speed, 0.0)

    @property
    def clock_start(self) -> Scalar:
        """See `Driver.clock_start`."""
        return self.position

    @property
    def clock_rate(self) -> Scalar:
        """See `Driver.clock_rate`."""
        return self.speed


class MovingDriver(Driver):
    """Prescribed motion that is a function of time: position + motion(t); its clock shows t."""

    motion: Prescribed

    def at(self, clock: Scalar) -> Derivatives:
        """See `Driver.at`."""
        moved = self.motion.at(clock)
        return moved._replace(value=self.position + moved.value)

    @property
    def clock_start(self) -> Scalar:
        """See `Driver.clock_start`."""
        return 0.0

    @property
    def clock_rate(self) -> Scalar:
        """See `Driver.clock_rate`."""
        return 1.0


def _form_of_driver(value: Any) -> str:
    return "motion" if has(value, "motion") else "speed"


AnyDriver = Annotated[
    Annotated[SteadyDriver, form("speed")] | Annotated[MovingDriver, form("motion")],
    discriminated_by(_form_of_driver, "a driver is an object with 'speed' or with 'motion'"),
]
