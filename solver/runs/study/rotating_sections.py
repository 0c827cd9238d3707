"""Sections of motions that go round: curves about a cylinder, closed in no plane of states."""

import numpy as np

from jointplay.records.arrays import Flags, Floats
from jointplay.solver.linear_algebra.principal_directions import along_principal_directions
from jointplay.solver.nonlinear.estimate import Estimate
from jointplay.solver.nonlinear.rotation import rotation_number
from jointplay.solver.nonlinear.whole_turns import goes_round
from jointplay.solver.quantities.scalars import sine_cosine

SWING = 0.25
"""Share of its radius by which a ring is uneven."""


def rotation_of(states: Floats, scales: Floats, angles: Flags, coordinates: int) -> Estimate | None:
    """Return the rotation number in the plane of largest spread, or else about an angle's circle.

    states : (n, states) in what counts as one, with speeds behind so many coordinates. scales :
    (states,) that. angles : (states,) which are angles.
    """
    found = rotation_number(principal_plane(states, coordinates))
    for column in np.flatnonzero(angles):
        if found is None:
            others = np.delete(states, column, axis=1)
            found = rotation_number(ring(states[:, column] * scales[column], others))
    return found


def with_unit_vectors(states: Floats, scales: Floats, angles: Flags) -> Floats:
    """Return the states, with cosine and sine for an angle that goes round.

    Wherever its circle is cut the angle jumps, and a smooth motion looks irregular.
    """
    found = []
    for column, scale, turning in zip(states.T, scales, angles, strict=True):
        if turning and goes_round(column * scale):
            sine, cosine = sine_cosine(column * scale)
            found += [cosine / scale, sine / scale]
        else:
            found.append(column)
    return np.stack(found, axis=1)


def ring(angle: Floats, others: Floats) -> Floats:
    """Return (n, 2) points at angles, rad, of a radius that others say by their largest spread.

    others : (n, states) besides the angle.
    """
    (along,) = along_principal_directions(others - others.mean(axis=0), 1)
    radius = 1.0 + SWING * along / (np.abs(along).max() or 1.0)
    sine, cosine = sine_cosine(angle)
    return np.stack([radius * cosine, radius * sine], axis=1)


def principal_plane(states: Floats, coordinates: int) -> Floats:
    """Return the states seen along the two directions in which they spread most, (n, 2).

    From the side from which free oscillations turn counter-clockwise: positive speeds, which
    follow the first coordinates, are below. So a motion that changes little keeps its sense, even
    where another state begins to spread most.
    """
    centred = states - states.mean(axis=0)
    along = np.column_stack(along_principal_directions(centred, 2))
    first, second = (np.add.reduce(centred * part[:, None], axis=0) for part in along.T)
    position, speed = slice(0, coordinates), slice(coordinates, 2 * coordinates)
    clockwise = (first[position] * second[speed] - second[position] * first[speed]).sum() > 0.0
    return along * [1.0, -1.0] if clockwise else along
