"""A motor whose torque falls with its speed."""

from typing import Annotated, ClassVar, Literal

from jointplay.solver.laws.force.law import Effect, Ends, ForceElement
from jointplay.solver.quantities.units import Rule, quantity


class Motor(ForceElement):
    """M = stall_torque (1 - ω / no_load_speed), on the second point's body, the rotor.

    ω is the rotor's angular velocity less that of the first point's body, the stator, on which the
    opposite acts. Beyond the speed without load it brakes. A flywheel is inertia of the rotor.

    Assumes a characteristic that is a straight line and followed at once, as that of a motor with
    constant field at constant voltage. Fails in times as short as those of its windings, and for
    asynchronous motors beyond their steep branch.

    Source: Fitzgerald, Kingsley and Umans 2003, Electric Machinery (speed and torque of
    motors with constant field).
    """

    is_moment: ClassVar[bool] = True
    type: Literal["motor"]
    stall_torque: Annotated[float, quantity("N m", ge=-1e12, le=1e12)]
    no_load_speed: Annotated[float, quantity("rad/s", ge=-1e5, le=1e5)]
    rules: ClassVar[tuple[Rule, ...]] = (
        Rule(
            "no_load_speed",
            lambda motor: motor.stall_torque * motor.no_load_speed <= 0.0,
            lambda motor: (
                f"A torque of {motor.stall_torque:g} N m does not drive a motor towards"
                f" {motor.no_load_speed:g} rad/s; give both one sign, and neither zero."
            ),
        ),
    )
    channels: ClassVar[tuple[tuple[str, str, str], ...]] = (
        ("moment", "N m", "moment on the rotor"),
        ("speed", "rad/s", "angular velocity of the rotor against the stator"),
    )

    def effect(self, ends: Ends) -> Effect:
        """Return the moment; what it puts in is a loss below zero."""
        speed = ends.spins[1] - ends.spins[0]
        moment = self.stall_torque * (1.0 - speed / self.no_load_speed)
        channels = {"moment": moment, "speed": speed}
        return Effect((0.0, 0.0), channels, loss=-(moment * speed), moment=moment)

    def strength(self, length: float) -> float:
        """Return its torque at rest as a force at a length, N."""
        return abs(self.stall_torque) / length

    @property
    def fastest(self) -> float:
        """The speed without load."""
        return abs(self.no_load_speed)
