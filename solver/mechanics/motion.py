"""What both formulations of the equations of motion hand on: accelerations, contacts, reactions."""

from __future__ import annotations

from dataclasses import dataclass

from jointplay.solver.mechanics.frames import Pair
from jointplay.solver.mechanics.play import Contact
from jointplay.solver.quantities.scalars import Scalar


@dataclass(frozen=True)
class BodyMotion:
    """Motion of a body's centre of mass in the world frame; m, rad and seconds."""

    position: Pair
    angle: Scalar
    velocity: Pair
    spin: Scalar
    acceleration: Pair
    angular_acceleration: Scalar


@dataclass(frozen=True)
class Motion:
    """A mechanism at one instant, its accelerations known.

    `accelerations` : one per coordinate of the formulation, in the order of its state.
    `joint_force` : force on a joint's second body (journal, slider, part), N, world components.
    `driver_effort` : torque (N m) or force (N) of each driver along its motion; `driver_speed`.
    """

    accelerations: list[Scalar]
    bodies: dict[str, BodyMotion]
    contacts: dict[str, Contact]
    joint_force: dict[str, Pair]
    driver_effort: dict[str, Scalar]
    driver_speed: dict[str, Scalar]
