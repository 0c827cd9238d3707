"""Slips that friction follows, of a run: those of pairs, and the argument of a table of a rate."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.continuation.friction_phases import phases
from jointplay.solver.kernels.loop.runs import SAMPLES
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.laws.force import Ends, ForceElement
from jointplay.solver.laws.force.varying import Varying
from jointplay.solver.laws.function.table import Table
from jointplay.solver.mechanics.courses import acting_between
from jointplay.solver.quantities.elementary import sine_cosine
from jointplay.solver.quantities.frames import WORLD
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.pairs import contact_pairs

MOTION = "x", "y", "theta", "vx", "vy", "omega"
"""Channels of a body that tell how its points move."""
FEWEST_ROWS = 3
"""Rows of a run by which its phases are told, at least."""


class FrictionSlip(NamedTuple):
    """A slip that friction follows, and the ramp in which that turns over."""

    name: str
    """That of the pair or the force element."""
    low: float
    high: float
    """Ends of the ramp, m/s or rad/s."""
    pair: int | None
    """Index of the pair; none: of a force element."""


def friction_slips(scene: Scene) -> tuple[FrictionSlip, ...]:
    """Return the slips of a scene: of pairs with friction, and forces that oppose a rate."""
    found = list[FrictionSlip]()
    for index, (name, pair) in enumerate(contact_pairs(scene).items()):
        law = pair.clearance.friction
        if law is not None and not law.is_off and np.isfinite(law.full_slip_speed):
            width = float(law.full_slip_speed)
            found.append(FrictionSlip(name, -width, width, index))
    for name, element in scene.forces.items():
        if ramp := _ramp(element):
            found.append(FrictionSlip(name, *ramp, None))
    return tuple(found)


def _ramp(element: ForceElement) -> tuple[float, float] | None:
    """Return between which rates a force that is a table of one turns over; None: it does not."""
    over = element.follows()
    if over is None or not over.rate or over.quantity == "driver":
        return None
    if not isinstance(element, Varying) or not isinstance(element.course, Table):
        return None
    knots, values = element.course.knots, element.course.values
    turns = [k for k in range(len(values) - 1) if values[k] * values[k + 1] < 0.0]
    return (float(knots[turns[0]]), float(knots[turns[0] + 1])) if len(turns) == 1 else None


class Slips:
    """Collects the slips of a bundle's first lane while it advances."""

    def __init__(self, bundle: Bundle, scene: Scene) -> None:
        """Begin with none."""
        self._bundle, self._scene, self._slips = bundle, scene, friction_slips(scene)
        names = [f"{one.name}.slip_velocity" for one in self._slips if one.pair is not None]
        if len(names) < len(self._slips):
            names += [f"{body}.{one}" for body in scene.bodies for one in MOTION]
        self._names = names
        self._columns = np.array([bundle.kernel.rows.index(one) for one in names], np.int64)
        self._values = [np.zeros((0, len(names)))]
        self._touching = [np.zeros((0, len(bundle.kernel.pairs)), np.bool_)]
        self._begun = np.zeros(len(bundle.kernel.pairs), np.int64)

    def collect(self) -> None:
        """Take what the bundle has handed out in its last call."""
        rows, at = self._bundle.rows(SAMPLES, 0), self._bundle.kernel.row
        if len(rows) and self._slips:
            self._values.append(self._bundle.observe(0, rows, self._columns))
            self._touching.append(rows[:, at.mode : at.impact_rate] > 0.0)
        contacts = self._bundle.impacts(0)
        np.add.at(self._begun, contacts["joint"][contacts["onset"] > 0.0], 1)

    def phases(self) -> list[int]:
        """Return how often each slip sticks and slides, in turn, of pairs while they touch.

        Of a run that failed before it had three rows all are 0.
        """
        if sum(map(len, self._values)) < FEWEST_ROWS:
            return [0] * (2 * len(self._slips))
        values = dict(zip(self._names, np.concatenate(self._values).T, strict=True))
        touching, found = np.concatenate(self._touching), list[int]()
        for one in self._slips:
            if one.pair is None:
                slip = _argument(self._scene, one.name, values)
                found += phases(slip, one.low, one.high)
                continue
            slip, touches = values[f"{one.name}.slip_velocity"], touching[:, one.pair]
            opens = () if touches.all() else (touches, int(self._begun[one.pair]))
            found += phases(slip, one.low, one.high, *opens)
        return found


def _argument(scene: Scene, name: str, values: Mapping[str, Floats]) -> Floats:
    """Return the rate that a force depends on, from channels of bodies."""

    def ends(first: str, second: str) -> Ends:
        one, other = (_point(scene, reference, values) for reference in (first, second))
        x, y, vx, vy, angle, spin = (b - a for a, b in zip(one, other, strict=True))
        zero = 0.0 * angle
        return Ends((x, y), (vx, vy), (zero, spin), angles=(zero, angle))

    return np.asarray(acting_between(scene, name, ends, {}).argument, np.float64)


def _point(scene: Scene, reference: str, values: Mapping[str, Floats]) -> list[Floats]:
    """Return position, velocity, angle and angular velocity of a named point."""
    body, point = reference.split(".")
    if body == WORLD:
        position = scene.ground.points[point]
        return [np.array(one) for one in (*position, 0.0, 0.0, 0.0, 0.0)]
    across, up = scene.bodies[body].points[point]
    x, y, angle, vx, vy, spin = (values[f"{body}.{one}"] for one in MOTION)
    sine, cosine = sine_cosine(angle)
    dx, dy = across * cosine - up * sine, across * sine + up * cosine
    return [x + dx, y + dy, vx - spin * dy, vy + spin * dx, angle, spin]
