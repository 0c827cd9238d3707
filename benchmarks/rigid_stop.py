"""Closed forms of the oscillator with a rigid stop: where impacts begin, and what becomes of them.

x'' + c x' + k x = k A cos(w t), a stop at d that leaves the share e of the speed. F is the flow
over a period T = 2 pi / w, v the speed of the impact, one in a period. The displacement d - v u1
and the rate v u2 of the steady motion at the impact are known from
u = inv([[1 - F11, F12], [-F21, F22 - 1]]) [-e F12, -e F22 - 1], so that v gives the amplitude. The
multipliers' product is e^2 exp(-c T), and their sum a constant and a share of 1 / v: each of fold
(a multiplier of 1) and doubling (of -1) has one v.
"""

from dataclasses import dataclass

import numpy as np

from jointplay.records.arrays import Flags, Floats

STIFFNESS, DAMPING, GAP, RESTITUTION = 400.0, 2.0, 0.01, 0.8  # N/m, N s/m, m, of 1 kg
_INSTANTS = 400


@dataclass(frozen=True)
class Curve:
    """Amplitudes, m, at which something happens, over speeds; NaN where it does not."""

    amplitude: Floats
    admissible: Flags
    """Whether the orbit stays on its side of the stop between its impacts."""


def response(speed: Floats) -> Floats:
    """Return the displacement a unit of force gives, m/N, at speeds in rad/s."""
    return np.asarray(1.0 / np.abs(STIFFNESS - speed**2 + 1j * DAMPING * speed))


def flow(time: Floats) -> Floats:
    """Return (..., 2, 2): displacement and rate after a time, s, by those before it."""
    decay = DAMPING / 2.0
    own = np.sqrt(STIFFNESS - decay**2)
    s, c = np.sin(own * time), np.cos(own * time)
    rows = [[c + decay / own * s, s / own], [-STIFFNESS / own * s, c - decay / own * s]]
    return np.exp(-decay * time)[..., None, None] * np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def grazing(speed: Floats) -> Curve:
    """Return the amplitudes at which the motion without impacts touches the stop."""
    return Curve(GAP / (STIFFNESS * response(speed)), np.ones(len(speed), np.bool_))


def fold(speed: Floats) -> Curve:
    """Return the amplitudes from which on there is an orbit of one impact a period."""
    return _with_multiplier(speed, 1.0)


def doubling(speed: Floats) -> Curve:
    """Return the amplitudes at which that orbit doubles its period."""
    return _with_multiplier(speed, -1.0)


def _with_multiplier(speed: Floats, multiplier: float) -> Curve:
    steady, impact = one_impact(speed, multiplier)
    reach = np.hypot(steady[0], steady[1] / speed)
    return Curve(reach / (STIFFNESS * response(speed)), _stays(speed, steady, impact))


def one_impact(speed: Floats, multiplier: float) -> tuple[Floats, Floats]:
    """Return displacement and rate of the steady motion at the impact, and that one's speed."""
    period, e = 2.0 * np.pi / speed, RESTITUTION
    f = flow(period)
    f11, f12, f21, f22 = f[:, 0, 0], f[:, 0, 1], f[:, 1, 0], f[:, 1, 1]
    matrix = np.moveaxis(np.array([[1.0 - f11, f12], [-f21, f22 - 1.0]]), 2, 0)
    side = np.stack([-e * f12, -e * f22 - 1.0], axis=1)
    u1, u2 = np.linalg.solve(matrix, side[..., None])[..., 0].T
    product = e**2 * np.exp(-DAMPING * period)
    rate = DAMPING * u2 - (STIFFNESS - speed**2) * u1
    constant = (f11 + f22) * e - f12 * (1.0 + e) * rate
    impact = -f12 * (1.0 + e) * speed**2 * GAP / (multiplier * (1.0 + product) + constant)
    impact = np.where(impact > 0.0, impact, np.nan)
    return np.stack([GAP - impact * u1, impact * u2]), impact


def _stays(speed: Floats, steady: Floats, impact: Floats) -> Flags:
    """Return whether orbits with an impact of that speed stay below the stop between impacts."""
    shares = np.linspace(0.0, 1.0, _INSTANTS + 1)[1:-1]
    after = np.stack([GAP - steady[0], -RESTITUTION * impact - steady[1]], axis=1)
    found = np.ones(len(speed), np.bool_)
    for share in shares:
        turn = 2.0 * np.pi * share
        own = (flow(2.0 * np.pi * share / speed) @ after[..., None])[:, 0, 0]
        position = own + steady[0] * np.cos(turn) + steady[1] / speed * np.sin(turn)
        found &= position < GAP
    return found
