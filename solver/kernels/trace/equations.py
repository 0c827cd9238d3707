"""Records a scene's equations of motion: once, from the readable mechanics."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice
from types import MappingProxyType
from typing import NamedTuple

from jointplay.solver.joints.contact import Contact
from jointplay.solver.kernels.layout import MOTION
from jointplay.solver.kernels.trace.derivative import Derivative
from jointplay.solver.kernels.trace.knots import KnotsOnPath, knots_on_path
from jointplay.solver.kernels.trace.reachable import reachable
from jointplay.solver.kernels.trace.tracer import Expression, Tracer
from jointplay.solver.mechanics.closing_rows import closing_rows
from jointplay.solver.mechanics.kinematics import Kinematics
from jointplay.solver.mechanics.lagrange import LagrangeMechanism
from jointplay.solver.mechanics.loops import Loops
from jointplay.solver.mechanics.motion import Motion
from jointplay.solver.mechanics.observe import channel_values, ledger_rates, stored_energy
from jointplay.solver.mechanics.reduced import ReducedMechanism
from jointplay.solver.mechanics.tree import Tree
from jointplay.solver.mechanics.view import view
from jointplay.solver.quantities.scalars import SLIGHT, Scalar
from jointplay.solver.scene.clocks import clocks
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.domains import bounded_courses
from jointplay.solver.scene.drivers import SteadyDriver
from jointplay.solver.scene.references import inner_states


@dataclass(frozen=True)
class Equations:
    """Equations that kernels evaluate, as expressions of the variables.

    The variables are ``stage0…`` (coordinates, their speeds, inner states of friction laws in the
    order of pairs), ``stage_time`` (s within the period), ``phase<k>`` (clock k at local time
    zero), ``wound<k>`` (its whole turns before that, rad, for angles that are shown; trigonometry
    needs no turns), ``mode<j>`` and ``impact_rate<j>`` of contact pair j, in document order.
    """

    tracer: Tracer
    coordinates: tuple[str, ...]
    drivers: tuple[str, ...]
    clocks: tuple[str, ...]
    pairs: tuple[str, ...]
    accelerations: tuple[Expression, ...]
    inner_rates: tuple[Expression, ...]
    ledger: tuple[Expression, ...]
    """Rates: work into contacts, friction loss, each driver's work, each pair's impulse."""
    penetrations: tuple[tuple[Expression, Expression], ...]
    """Penetration (m) and its rate (m/s) of each contact pair."""
    slips: tuple[tuple[Expression, Expression], ...]
    """Slip that each pair's friction follows (m/s), and its rate (m/s^2)."""
    eccentricities: tuple[tuple[Expression, ...], ...]
    """Motion of each pair's journal, see `MOTION`."""
    enclosures: tuple[str, ...]
    """Enclosure of that motion while the pair is apart, see `Contact`."""
    channels: dict[str, Expression]
    """Every channel, then ``stored`` (elastic energy, J), of the state and its accelerations."""
    loops: Loops | None
    """Joints that close loops, at the stage; none in an open scene."""
    multipliers: tuple[Expression, ...]
    """Lagrange multipliers of the rows of `loops`, N or N m."""
    corrections: tuple[Expression, ...]
    """Changes of coordinates and speeds that close the loops again; none in an open scene."""
    knots: tuple[KnotsOnPath, ...]
    """Knots of functions that slopes depend on."""

    @property
    def states(self) -> int:
        """Number of states: the coordinates, their speeds, inner states."""
        return 2 * len(self.coordinates) + len(self.inner_rates)

    @property
    def slopes(self) -> tuple[tuple[int, Expression], ...]:
        """Rates of all states but the coordinates, whose rates are speeds, by index of state."""
        rates = self.accelerations + self.inner_rates
        return tuple(enumerate(rates, start=len(self.coordinates)))


def trace(scene: Scene, tree: Tree, formulation: str, tracer: Tracer | None = None) -> Equations:
    """Run the mechanics on expressions of a tracer, by default a new one.

    Raises
    ------
    LimitExceeded
        The scene's equations are too long to compile.
    """
    tracer = tracer or Tracer()
    coordinates = tree.coordinates
    if formulation == "lagrange":
        axes = ("x", "y", "theta")
        coordinates = tuple(f"{body}.{axis}" for body in scene.bodies for axis in axes)
    traced = _traced(scene, tree, formulation, tracer, coordinates)
    motion, contacts = traced.motion, traced.motion.contacts.values()
    lift = tracer.lift
    channels = {n: lift(c) for n, c in channel_values(traced.numbers, traced.observed).items()}
    for body, wound in traced.windings.items():
        channels[f"{body}.theta"] = channels[f"{body}.theta"] + wound
    channels["stored"] = lift(stored_energy(traced.observed))
    accelerations = tuple(map(lift, motion.accelerations))
    for name in bounded_courses(scene):  # no number where it is refused, though it moves nothing
        refused = SLIGHT * lift(motion.forces.elements[name].power)
        accelerations = (accelerations[0] + refused, *accelerations[1:])
    inner_rates = tuple(lift(rate) for found in contacts for rate in found.inner_rates)
    derivative = _along_motion(tracer, accelerations)
    slips = [lift(found.friction_slip) for found in contacts]
    return Equations(
        tracer,
        coordinates,
        tuple(scene.drivers),
        tuple(clocks(scene)),
        tree.pairs,
        accelerations,
        inner_rates,
        tuple(map(lift, ledger_rates(traced.numbers, motion).values())),
        tuple((lift(found.penetration), lift(found.penetration_rate)) for found in contacts),
        tuple((slip, derivative(slip)) for slip in slips),
        tuple(_path(found, lift, derivative) for found in contacts),
        tuple(found.enclosure for found in contacts),
        channels,
        traced.loops,
        tuple(map(lift, motion.multipliers)),
        tuple(map(lift, traced.corrections)),
        knots_on_path([*accelerations, *inner_rates], derivative),
    )


class _Traced(NamedTuple):
    """The mechanics of expressions."""

    numbers: Scene
    """The scene, of expressions in place of its numbers."""
    motion: Motion
    observed: Motion
    """The same, of accelerations that the lanes have already."""
    windings: Mapping[str, Expression] = MappingProxyType({})
    loops: Loops | None = None
    corrections: Sequence[Scalar] = ()


def _traced(
    scene: Scene, tree: Tree, formulation: str, tracer: Tracer, coordinates: Sequence[str]
) -> _Traced:
    """Run the mechanics on variables of a tracer; see `Equations`."""
    numbers, count = view(scene, tracer.number), len(coordinates)
    laws = {pair: len(states) for pair, states in inner_states(scene).items()}
    stage = [tracer.variable(f"stage{i}") for i in range(2 * count + sum(laws.values()))]
    position, speed, own = stage[:count], stage[count : 2 * count], iter(stage[2 * count :])
    driven = _driven(scene, numbers, tracer, turning=formulation == "lagrange")
    contact = (
        {pair: tracer.variable(f"mode{j}") for j, pair in enumerate(tree.pairs)},
        {pair: tracer.hold(f"impact_rate{j}") for j, pair in enumerate(tree.pairs)},
        {pair: list(islice(own, states)) for pair, states in laws.items()},
    )
    if formulation == "lagrange":
        motion = LagrangeMechanism(scene, numbers, position, speed, driven).motion(*contact)
        return _Traced(numbers, motion, motion)
    windings = _windings(scene, tree, tracer)
    positions = dict(zip(coordinates, position, strict=True))
    speeds = dict(zip(coordinates, speed, strict=True))
    mechanism = ReducedMechanism(tree, numbers, positions, speeds, driven, windings)
    motion = mechanism.motion(*contact)
    known: list[Scalar] = [tracer.variable(f"slope{count + i}") for i in range(count)]
    observed = mechanism.motion(*contact, known)
    loops = mechanism.loops() if tree.closing else None
    corrections = () if loops is None else _corrections(mechanism, loops)
    return _Traced(numbers, motion, observed, windings, loops, corrections)


def _driven(
    scene: Scene, numbers: Scene, tracer: Tracer, *, turning: bool
) -> dict[str, Expression]:
    """Return where clocks are; where driven angles are coordinates, these go on `turning`."""
    time = tracer.variable("stage_time")
    driven: dict[str, Expression] = {}
    for k, name in enumerate(clocks(scene)):
        start, driver = tracer.variable(f"phase{k}"), numbers.drivers.get(name)
        driven[name] = start + (time if driver is None else driver.clock_rate * time)
    for k, (name, driver) in enumerate(scene.drivers.items()):
        if turning and isinstance(driver, SteadyDriver):
            driven[name] = driven[name] + tracer.variable(f"wound{k}")
    return driven


def _along_motion(tracer: Tracer, accelerations: Sequence[Expression]) -> Derivative:
    """Return the derivative in time, along the motion."""
    count = len(accelerations)
    along = {f"stage{i}": tracer.variable(f"stage{count + i}") for i in range(count)}
    along |= {f"stage{count + i}": a for i, a in enumerate(accelerations)}
    return Derivative(along | {"stage_time": tracer.constant(1.0)})


def _corrections(mechanism: ReducedMechanism, loops: Loops) -> list[Scalar]:
    """Return one Newton step of the coordinates, and then of the speeds, that closes loops.

    Both with the Jacobian before: at what one step of integration leaves, its error is as small as
    the drift, so that what remains is the drift's square.
    """
    k = mechanism.kinematics
    moves = loops.correction([row.value for row in loops.rows])
    position = {n: q + move for (n, q), move in zip(k.position.items(), moves, strict=True)}
    speed = {name: k.speed[name] for name in k.tree.coordinates}
    moved = Kinematics(k.tree, k.numbers, position, speed, k.driven)
    return [*moves, *loops.correction([row.rate for row in closing_rows(moved)])]


def _path(
    found: Contact, lift: Callable[[Scalar], Expression], derivative: Derivative
) -> tuple[Expression, ...]:
    """Return position, rate and acceleration of a journal's centre."""
    rates = [*map(lift, found.eccentricity_rate)]
    return (*map(lift, found.eccentricity), *rates, *map(derivative, rates))


def _windings(scene: Scene, tree: Tree, tracer: Tracer) -> dict[str, Expression]:
    """Whole turns of bodies that drivers turn steadily, as seen from the ground."""
    drivers = list(scene.drivers)
    steady = {name for name, d in scene.drivers.items() if isinstance(d, SteadyDriver)}
    found: dict[str, Expression] = {}
    for branch in tree.branches:
        if branch.turned_by in steady:
            found[branch.body] = tracer.variable(f"wound{drivers.index(branch.turned_by)}")
        wound = found.get(branch.parent)
        free = branch.freedom == "all" or f"{branch.body}.theta" in branch.coordinates
        if free or branch.turned_by is not None:
            continue
        if branch.freedom == "turn" and branch.driver in steady:
            own = tracer.variable(f"wound{drivers.index(branch.driver)}")
            own = own if branch.outward else -own
            wound = own if wound is None else wound + own
        if wound is not None:
            found[branch.body] = wound
    return found


def numbered(
    names: Sequence[str], rows: Iterable[tuple[Expression, ...]]
) -> list[tuple[str, Expression]]:
    """Return expressions by names of slots: those of a row, with its number behind each."""
    return [
        (f"{name}{j}", one)
        for j, row in enumerate(rows)
        for name, one in zip(names, row, strict=True)
    ]


def right_hand_side(equations: Equations) -> list[tuple[str, Expression]]:
    """Return what is needed where a step ends: slopes, gaps, slips, journals."""
    count = len(equations.coordinates)
    speeds = [equations.tracer.variable(f"stage{count + i}") for i in range(count)]
    outputs = [(f"slope{i}", rate) for i, rate in (*enumerate(speeds), *equations.slopes)]
    outputs += numbered(("penetration", "penetration_rate"), equations.penetrations)
    outputs += numbered(("slip", "slip_rate"), equations.slips)
    for j, path in enumerate(equations.eccentricities):
        outputs += [(f"eccentricity{MOTION * j + k}", part) for k, part in enumerate(path)]
    return outputs


def needed_again(equations: Equations) -> list[Expression]:
    """Return what observing needs of the right-hand side: sines, cosines, multipliers."""
    functions = equations.tracer.functions
    angles = [
        node
        for node in reachable(expression for _, expression in right_hand_side(equations))
        if node.index in functions and functions[node.index].name in ("sin", "cos")
    ]
    return [*angles, *(node for node in equations.multipliers if not node.fixed)]
