"""Shared parts of both formulations: forces between bodies, the motion."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import count
from types import MappingProxyType
from typing import Any

from jointplay.solver.joints import Joint
from jointplay.solver.joints.contact import Contact, ContactState, Interaction
from jointplay.solver.laws.force import Effect
from jointplay.solver.mechanics.courses import EndsOf, acting_between
from jointplay.solver.quantities.frames import Pair
from jointplay.solver.quantities.scalars import Scalar, Scalars
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.pairs import pairs_of

NOTHING: Mapping[str, Any] = MappingProxyType({})


@dataclass(frozen=True)
class Element:
    """A force element at one instant."""

    effect: Effect
    interaction: Interaction
    power: Scalar
    """Power that goes into the element, W."""


@dataclass(frozen=True)
class Forces:
    """Forces between bodies beside constraints, by the name of the contact pair or the element."""

    contacts: dict[str, Contact] = field(default_factory=dict)
    elements: dict[str, Element] = field(default_factory=dict)

    @property
    def interactions(self) -> Iterator[Interaction]:
        """Forces and moments on the bodies."""
        for found in self.contacts.values():
            yield found.interaction
        for element in self.elements.values():
            yield element.interaction

    def of_joints(self) -> dict[str, Pair]:
        """Return the force on the second body of each joint with play, N, world components."""
        found: dict[str, Pair] = {}
        for acting in self.contacts.values():
            (x, y), before = acting.interaction.force_on_second, found.get(acting.joint)
            found[acting.joint] = (x, y) if before is None else (before[0] + x, before[1] + y)
        return found

    def held(self, joints: Mapping[str, Joint]) -> dict[str, Scalar]:
        """Return the moment on the second body of joints with play that have one to tell, N m.

        About the second point: of guides, flat faces on cams, and journals in oil.
        """
        found: dict[str, Scalar] = {}
        for acting in self.contacts.values():
            if joints[acting.joint].has_moment:
                moment = acting.interaction.moment_on_second
                found[acting.joint] = found.get(acting.joint, 0.0) + moment
        return found


@dataclass(frozen=True)
class BodyMotion:
    """Motion of a body's centre of mass in the world frame; m, rad and seconds."""

    position: Pair
    angle: Scalar
    velocity: Pair
    spin: Scalar
    acceleration: Pair
    angular_acceleration: Scalar


def body_motions(names: Iterable[str], q: Scalars, v: Scalars, a: Scalars) -> dict[str, BodyMotion]:
    """Return the motion of bodies from x, y, theta of each, their rates and accelerations."""
    return {
        name: BodyMotion(
            (q[i], q[i + 1]), q[i + 2], (v[i], v[i + 1]), v[i + 2], (a[i], a[i + 1]), a[i + 2]
        )
        for i, name in zip(count(0, 3), names)
    }


@dataclass(frozen=True)
class Motion:
    """A mechanism at one instant, its accelerations known.

    `accelerations` : one per coordinate of the formulation, in the order of its state.
    `joint_force` : force on a joint's second body (journal, slider, part), N, world components.
    `held_moment` : moment on it, about its point, of joints that hold an angle, or with play have
    one to tell, N m.
    `driver_effort` : torque (N m) or force (N) of each driver along its motion; `driver_speed`.
    """

    accelerations: list[Scalar]
    bodies: dict[str, BodyMotion]
    forces: Forces
    joint_force: dict[str, Pair]
    held_moment: dict[str, Scalar]
    driver_effort: dict[str, Scalar]
    driver_speed: dict[str, Scalar]
    multipliers: Sequence[Scalar] = ()
    """Forces (N) and moments (N m) of joints that close loops, along the directions they hold."""

    @property
    def contacts(self) -> dict[str, Contact]:
        """Actions of contact pairs, by name."""
        return self.forces.contacts


def forces_between(
    numbers: Scene,
    ends: EndsOf,
    clocks: Mapping[str, Scalar],
    play: Iterable[str] = (),
    modes: Mapping[str, Scalar] = NOTHING,
    impact_rates: Mapping[str, Scalar] = NOTHING,
    inner: Mapping[str, Sequence[Scalar]] = NOTHING,
) -> Forces:
    """Evaluate joints with play and force elements.

    `clocks` by driver and by element that varies with time; `play` are
    joints whose contact counts. Each of their pairs has a mode and an impact rate (m/s), and
    `inner` states where its friction law has any.
    """
    forces = Forces()
    for name in play:
        joint = numbers.joints[name]
        between = ends(*joint.points)
        for pair in pairs_of(name, joint):
            state = ContactState(
                modes[pair.name], impact_rates[pair.name], inner.get(pair.name, ())
            )
            forces.contacts[pair.name] = joint.contact(name, pair.part, between, state)
    for name, element in numbers.forces.items():
        between = acting_between(numbers, name, ends, clocks)
        effect = element.effect(between)
        (fx, fy), (vx, vy), (first, second) = effect.force, between.rate, between.spins
        power = -(fx * vx + fy * vy) - effect.moment * (second - first) - effect.couple * first
        on_first = effect.couple - effect.moment
        acting = Interaction(element.first, element.second, effect.force, on_first, effect.moment)
        forces.elements[name] = Element(effect, acting, power)
    return forces
