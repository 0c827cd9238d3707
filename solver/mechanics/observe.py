"""From a mechanism in motion to the values of its channels and the terms of its energy ledger."""

from collections.abc import Sequence

from jointplay.solver.joints import Joint
from jointplay.solver.joints.contact import Contact
from jointplay.solver.joints.joint import MOMENT
from jointplay.solver.laws.force import Ends
from jointplay.solver.mechanics.motion import BodyMotion, Motion
from jointplay.solver.quantities.frames import WORLD, minus
from jointplay.solver.quantities.scalars import Scalar, sine_cosine
from jointplay.solver.scene.channels import BODY, JOINT, PLAY, POINT, WALL
from jointplay.solver.scene.document import Scene


def channel_values(numbers: Scene, motion: Motion) -> dict[str, Scalar]:
    """Return the value of every channel by name; see `scene.channels` for units and meaning."""
    values: dict[str, Scalar] = {}
    for name, body in motion.bodies.items():
        values |= _named(name, BODY, body_values(body))
    for name, force in motion.joint_force.items():
        values |= _named(name, JOINT, force)
    for name, moment in motion.held_moment.items():
        values |= _named(name, MOMENT, (moment,))
    values |= _ideal_values(numbers, motion)
    for name, found in motion.contacts.items():
        values |= _contact_values(name, found)
    for name, effort in motion.driver_effort.items():
        values[f"{name}.torque"] = effort
        values[f"{name}.power"] = effort * motion.driver_speed[name]
    for name, element in motion.forces.elements.items():
        for quantity, value in element.effect.channels.items():
            values[f"{name}.{quantity}"] = value
    for point in numbers.recorded:
        values |= _named(point, POINT, point_values(numbers, motion, point))
    values["energy.kinetic"], values["energy.potential"] = energies(numbers, motion)
    for output in numbers.outputs:
        values[output.name] = output.factor * values[output.channel] + output.offset
    return values


def _ideal_values(numbers: Scene, motion: Motion) -> dict[str, Scalar]:
    """Return the values of the channels that joints have of their own without play."""
    values: dict[str, Scalar] = {}
    touching = {found.joint for found in motion.contacts.values()}
    for name, joint in numbers.joints.items():
        if joint.ideal_channels and name not in touching:
            found = joint.ideal_values(_ends(numbers, motion, joint), motion.joint_force[name])
            values |= _named(name, joint.ideal_channels, found)
    return values


def _contact_values(name: str, found: Contact) -> dict[str, Scalar]:
    """Return the values of a contact pair's channels."""
    forces = (found.normal_force, found.friction_force, found.slip_velocity)
    if found.enclosure == "circle":
        centre = (*found.eccentricity, *found.eccentricity_rate)
        values = _named(name, PLAY, (*centre, found.penetration, *forces))
    else:
        depth = found.penetration, found.penetration_rate
        values = _named(name, WALL, (*depth, *forces))
    return values | {f"{name}.{state}": value for state, value in found.inner.items()}


def body_values(body: BodyMotion) -> tuple[Scalar, ...]:
    """Return the values of a body's channels, in the order of `BODY`."""
    return (
        *(*body.position, body.angle),
        *(*body.velocity, body.spin),
        *(*body.acceleration, body.angular_acceleration),
    )


def _ends(numbers: Scene, motion: Motion, joint: Joint) -> Ends:
    """Return how a joint's second point lies against its first, without rates."""
    positions, angles = [], []
    for reference in joint.points:
        body, point = reference.split(".")
        if body == WORLD:
            x, y = numbers.ground.points[point]
            angles.append(0.0)
        else:
            x, y, _, _ = point_values(numbers, motion, reference)
            angles.append(motion.bodies[body].angle)
        positions.append((x, y))
    (sine, cosine), (other_sine, other_cosine) = map(sine_cosine, angles)
    turned = ((cosine, sine), (other_cosine, other_sine))
    gap, still = minus(positions[1], positions[0]), (0.0, 0.0)
    return Ends(gap, still, still, turned, (angles[0], angles[1]))


def point_values(numbers: Scene, motion: Motion, point: str) -> tuple[Scalar, ...]:
    """Return the values of a recorded point's channels, in the order of `POINT`."""
    name, own = point.split(".")
    body, (x, y) = motion.bodies[name], numbers.bodies[name].points[own]
    sine, cosine = sine_cosine(body.angle)
    across, up = cosine * x - sine * y, sine * x + cosine * y
    (px, py), (vx, vy) = body.position, body.velocity
    return px + across, py + up, vx - body.spin * up, vy + body.spin * across


def _named(
    part: str, table: tuple[tuple[str, str, str], ...], values: Sequence[Scalar]
) -> dict[str, Scalar]:
    return {
        f"{part}.{quantity}": value for (quantity, _, _), value in zip(table, values, strict=True)
    }


def energies(numbers: Scene, motion: Motion) -> tuple[Scalar, Scalar]:
    """Return kinetic energy and the potential energy of gravity (zero at the origin), J."""
    gx, gy = numbers.gravity
    kinetic: Scalar = 0.0
    potential: Scalar = 0.0
    for name, body in motion.bodies.items():
        mass, inertia = numbers.bodies[name].mass, numbers.bodies[name].inertia
        (x, y), (vx, vy), spin = body.position, body.velocity, body.spin
        kinetic = kinetic + 0.5 * (mass * (vx * vx + vy * vy) + inertia * (spin * spin))
        potential = potential - mass * (gx * x + gy * y)
    return kinetic, potential


def ledger_rates(numbers: Scene, motion: Motion) -> dict[str, Scalar]:
    """Return the powers whose integrals make the energy ledger, W, and the contact forces, N.

    ``contact``: power that goes into contacts, and into what elements store; ``friction``: power
    lost there; ``element``: power lost in force elements, if there are any;
    ``driver:<driver>``: power put in by each;
    ``impulse:<pair>``: normal force, whose integral over a contact is its impulse.
    """
    rates: dict[str, Scalar] = {"contact": 0.0, "friction": 0.0}
    for element in motion.forces.elements.values():
        rates["contact"] = rates["contact"] + (element.power - element.effect.loss)
        rates["element"] = rates.get("element", 0.0) + element.effect.loss
    for name, effort in motion.driver_effort.items():
        rates[f"driver:{name}"] = effort * motion.driver_speed[name]
    for name, found in motion.contacts.items():
        rates["contact"] = rates["contact"] + found.contact_power
        rates["friction"] = rates["friction"] + found.friction_loss
        rates[f"impulse:{name}"] = found.normal_force
    return rates


def stored_energy(motion: Motion) -> Scalar:
    """Return the energy stored in all contacts and force elements, J."""
    total: Scalar = 0.0
    for found in motion.contacts.values():
        total = total + found.elastic_energy
    for element in motion.forces.elements.values():
        total = total + element.effect.stored
    return total
