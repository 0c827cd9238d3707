"""True values of a scene's channels, by name, at given times."""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from benchmarks.lies.truth import integration
from benchmarks.lies.truth.contacts import (
    EX,
    EY,
    FRICTION,
    GAP,
    GAP_RATE,
    NORMAL_FORCE,
    RX,
    RY,
    SLIP,
    TOLD,
    VX,
    VY,
)
from benchmarks.lies.truth.equations import driven, stretch, turn
from benchmarks.lies.truth.mechanism import ANGLE, KIND, Floats, Named, has_play, read
from benchmarks.lies.truth.pairs import CIRCLE
from benchmarks.lies.truth.points import point

POSE = ("x", "y", "theta")
RATE = ("vx", "vy", "omega")
ACCELERATION = ("ax", "ay", "alpha")
CONTACT = {
    "eccentricity_x": EX,
    "eccentricity_y": EY,
    "eccentricity_rate_x": VX,
    "eccentricity_rate_y": VY,
    "penetration": GAP,
    "normal_force": NORMAL_FORCE,
    "friction_force": FRICTION,
    "slip_velocity": SLIP,
}
AT_WALL = {
    "penetration": GAP,
    "penetration_rate": GAP_RATE,
    "normal_force": NORMAL_FORCE,
    "friction_force": FRICTION,
    "slip_velocity": SLIP,
}
STILL = 1e-3
"""Smallest scale of speed, m/s."""


MOST_CONTACTS = 4096


class Told(NamedTuple):
    """A motion that the program computed.

    Attributes
    ----------
    values : (count,) values of each channel, by name
    onsets : times, s, at which contacts of each pair begin
    """

    values: dict[str, Floats]
    onsets: dict[int, Floats]


def true_channels(
    scene: Mapping[str, Any],
    first: Mapping[str, float],
    times: Floats,
    tolerance: float,
    share: float,
    most_attempts: int,
) -> Told | None:
    """Integrate a scene's filled-in document from the channels at its start.

    Parameters
    ----------
    first
        Position, angle and rates of each body at time 0, by the name of the channel.
    times
        (count,) s, rising.
    tolerance
        Error of a step, in clearances and in the speeds that journals have.
    share
        Of the longest steps that geometry allows.
    most_attempts
        Steps that may be tried.

    Returns
    -------
    None where it takes too long, has too many contacts, or constraints are redundant.
    """
    named = read(scene)
    m, bodies = named.mechanism, list(scene["bodies"])
    start = np.array(
        [first[f"{body}.{q}"] for part in (POSE, RATE) for body in bodies for q in part]
    )
    states = np.full((len(times), 2 * len(start)), np.nan)
    tolds = np.full((len(times), len(named.play), TOLD), np.nan)
    forces = np.full((len(times), len(m.row)), np.nan)
    began = np.full((MOST_CONTACTS, 2), np.nan)
    status = integration.integrate(
        m,
        start,
        np.asarray(times, np.float64),
        tolerance * _scales(scene, named, start),
        share,
        most_attempts,
        states,
        tolds,
        forces,
        began,
    )
    if status != integration.DONE or not np.isnan(began[-1, 0]):
        return None
    onsets = {j: began[began[:, 0] == j, 1] for j in range(len(named.play))}
    return Told(_values(scene, named, times, states, tolds, forces), onsets)


def _scales(scene: Mapping[str, Any], named: Named, start: Floats) -> Floats:
    """Return sizes of positions (m, rad) and speeds (m/s, rad/s) that matter, (states,)."""
    reach = max(math.hypot(*arm) for arm in named.mechanism.arm)
    reach = max(reach, float(named.mechanism.law[:, 1].max(initial=0.0)), 1e-9)
    finest = float(named.mechanism.law[:, 0].min(initial=reach))
    half = len(start) // 2
    rates = start[half:].reshape(-1, 3)
    speed = max(
        math.sqrt(math.hypot(*scene["gravity"]) * finest),
        float(np.abs(rates[:, 2]).max()) * finest,
        float(np.abs(rates[:, :2]).min()) if finest == reach else 0.0,
        STILL,
    )
    position = [finest, finest, finest / reach] * (half // 3)
    return np.array([*position, *(value * speed / finest for value in position)])


def _values(
    scene: Mapping[str, Any],
    named: Named,
    times: Floats,
    states: Floats,
    tolds: Floats,
    forces: Floats,
) -> dict[str, Floats]:
    values: dict[str, Floats] = {}
    bodies, half = list(scene["bodies"]), states.shape[1] // 4
    for b, body in enumerate(bodies):
        for level, names in ((0, POSE), (1, RATE), (3, ACCELERATION)):
            for q, name in enumerate(names):
                values[f"{body}.{name}"] = states[:, level * half + 3 * b + q]
    _contacts(named, tolds, values)
    _walls(named, states[:, : 2 * half], tolds, values)
    for name, joint in scene["joints"].items():
        if not has_play(joint):
            _reactions(name, joint, scene, named, forces, values)
    for name, row in named.drivers.items():
        values[f"{name}.torque"] = forces[:, row]
        speed = np.array([driven(named.mechanism, row, t)[1] for t in times])
        values[f"{name}.power"] = forces[:, row] * speed
    for s, name in enumerate(named.motors):
        found = np.array([turn(named.mechanism, s, y[: 2 * half]) for y in states])
        values[f"{name}.moment"], values[f"{name}.speed"] = found.T
    for s, name in enumerate(named.springs):
        found = np.array([stretch(named.mechanism, s, y[: 2 * half])[:3] for y in states])
        for column, channel in enumerate(("length", "rate", "force")):
            values[f"{name}.{channel}"] = found[:, column]
    _energies(scene, values)
    for output in scene["outputs"]:
        values[output["name"]] = output["factor"] * values[output["channel"]] + output["offset"]
    return values


def _contacts(named: Named, tolds: Floats, values: dict[str, Floats]) -> None:
    """Add what is told of journals with play."""
    for j, name in enumerate(named.play):
        if named.mechanism.wall[j, KIND] != CIRCLE:
            continue
        values |= {f"{name}.{channel}": tolds[:, j, at] for channel, at in CONTACT.items()}
        distance = np.hypot(tolds[:, j, EX], tolds[:, j, EY])[:, None]
        normal = tolds[:, j, EX : EY + 1] / np.where(distance > 0.0, distance, 1.0)
        push, rub = tolds[:, j, NORMAL_FORCE], tolds[:, j, FRICTION]
        values[f"{name}.force_x"] = -push * normal[:, 0] - rub * normal[:, 1]
        values[f"{name}.force_y"] = -push * normal[:, 1] + rub * normal[:, 0]


def _walls(named: Named, states: Floats, tolds: Floats, values: dict[str, Floats]) -> None:
    """Add what is told of guides, slots and cams with play, and what they do to the second body."""
    m = named.mechanism
    for j, name in enumerate(named.play):
        if m.wall[j, KIND] == CIRCLE:
            continue
        values |= {f"{name}.{channel}": tolds[:, j, at] for channel, at in AT_WALL.items()}
        normal, push, rub = (
            tolds[:, j, EX : EY + 1],
            tolds[:, j, NORMAL_FORCE],
            tolds[:, j, FRICTION],
        )
        force = np.stack(
            [-push * normal[:, 0] - rub * normal[:, 1], -push * normal[:, 1] + rub * normal[:, 0]],
            1,
        )
        centre = [
            np.subtract(point(m, m.play[j, 1], y)[2:4], point(m, named.sliders[j], y)[2:4])
            for y in states
        ]
        arm = np.array(centre) + tolds[:, j, RX : RY + 1]
        joint = name.rpartition(".")[0] or name
        moment = arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0]
        for channel, value in (
            ("force_x", force[:, 0]),
            ("force_y", force[:, 1]),
            ("moment", moment),
        ):
            values[f"{joint}.{channel}"] = values.get(f"{joint}.{channel}", 0.0) + value


def _reactions(
    name: str,
    joint: Mapping[str, Any],
    scene: Mapping[str, Any],
    named: Named,
    forces: Floats,
    values: dict[str, Floats],
) -> None:
    """Add the force on the second body of an ideal joint, and the moment that holds its angle."""
    rows = named.rows[name]
    if joint["type"] != "revolute":
        turning = next(row for row in rows if named.mechanism.row[row, 0] == ANGLE)
        values[f"{name}.moment"] = forces[:, turning]
    if joint["type"] != "prismatic":
        values[f"{name}.force_x"], values[f"{name}.force_y"] = (
            forces[:, rows[0]],
            forces[:, rows[1]],
        )
        return
    guide = joint["guide"].split(".")[0]
    angle = values[f"{guide}.theta"] if guide != "ground" else np.zeros(len(forces))
    ux, uy = named.mechanism.motion[rows[0], 2:4]
    ux, uy = np.cos(angle) * ux - np.sin(angle) * uy, np.sin(angle) * ux + np.cos(angle) * uy
    across = forces[:, rows[0]]
    along = forces[:, rows[2]] if len(rows) > 2 else np.zeros(len(forces))
    values[f"{name}.force_x"] = -across * uy + along * ux
    values[f"{name}.force_y"] = across * ux + along * uy


def _energies(scene: Mapping[str, Any], values: dict[str, Floats]) -> None:
    gx, gy = scene["gravity"]
    kinetic, potential = np.zeros(1), np.zeros(1)
    for name, body in scene["bodies"].items():
        x, y, vx, vy, spin = (values[f"{name}.{q}"] for q in ("x", "y", "vx", "vy", "omega"))
        kinetic = kinetic + 0.5 * (body["mass"] * (vx**2 + vy**2) + body["inertia"] * spin**2)
        potential = potential - body["mass"] * (gx * x + gy * y)
    values["energy.kinetic"], values["energy.potential"] = kinetic, potential
