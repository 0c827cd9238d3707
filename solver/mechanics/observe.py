"""From a mechanism in motion to the values of its channels and the terms of its energy ledger."""

from jointplay.solver.mechanics.motion import Motion
from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.scene.document import Scene


def channel_values(numbers: Scene, motion: Motion) -> dict[str, Scalar]:
    """Return the value of every channel by name; see `scene.channels` for units and meaning."""
    values: dict[str, Scalar] = {}
    for name, body in motion.bodies.items():
        values[f"{name}.x"], values[f"{name}.y"] = body.position
        values[f"{name}.theta"] = body.angle
        values[f"{name}.vx"], values[f"{name}.vy"] = body.velocity
        values[f"{name}.omega"] = body.spin
        values[f"{name}.ax"], values[f"{name}.ay"] = body.acceleration
        values[f"{name}.alpha"] = body.angular_acceleration
    for name, (x, y) in motion.joint_force.items():
        values[f"{name}.force_x"], values[f"{name}.force_y"] = x, y
    for name, found in motion.contacts.items():
        values[f"{name}.eccentricity_x"], values[f"{name}.eccentricity_y"] = found.eccentricity
        rate_x, rate_y = found.eccentricity_rate
        values[f"{name}.eccentricity_rate_x"] = rate_x
        values[f"{name}.eccentricity_rate_y"] = rate_y
        values[f"{name}.penetration"] = found.penetration
        values[f"{name}.normal_force"] = found.normal_force
        values[f"{name}.friction_force"] = found.friction_force
        values[f"{name}.slip_velocity"] = found.slip_velocity
        values |= {f"{name}.{state}": value for state, value in found.inner.items()}
    for name, effort in motion.driver_effort.items():
        values[f"{name}.torque"] = effort
        values[f"{name}.power"] = effort * motion.driver_speed[name]
    for name, element in motion.forces.elements.items():
        for quantity, value in element.effect.channels.items():
            values[f"{name}.{quantity}"] = value
    values["energy.kinetic"], values["energy.potential"] = energies(numbers, motion)
    for output in numbers.outputs:
        values[output.name] = output.factor * values[output.channel] + output.offset
    return values


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
    ``impulse:<joint>``: normal force, whose integral over a contact is its impulse.
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
