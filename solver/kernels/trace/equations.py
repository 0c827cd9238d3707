"""Records a scene's equations of motion: once, from the readable mechanics."""

from dataclasses import dataclass
from itertools import islice

from jointplay.solver.kernels.trace.derivative import Derivative
from jointplay.solver.kernels.trace.knots import KnotsOnPath, knots_on_path
from jointplay.solver.kernels.trace.reachable import reachable
from jointplay.solver.kernels.trace.tracer import Expression, Tracer
from jointplay.solver.mechanics.closing_rows import closing_rows
from jointplay.solver.mechanics.kinematics import Kinematics
from jointplay.solver.mechanics.lagrange import LagrangeMechanism
from jointplay.solver.mechanics.loops import Loops
from jointplay.solver.mechanics.observe import channel_values, ledger_rates, stored_energy
from jointplay.solver.mechanics.reduced import ReducedMechanism
from jointplay.solver.mechanics.tree import Tree
from jointplay.solver.mechanics.view import view
from jointplay.solver.quantities.frames import Pair
from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.scene.clocks import clocks
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.drivers import SteadyDriver
from jointplay.solver.scene.references import inner_states

KEEPS_LEDGER = "keeps_ledger"
"""Slot that is positive in lanes whose works and impulses are wanted."""
MOTION = ("x", "y", "rate_x", "rate_y", "acceleration_x", "acceleration_y")
"""Eccentricity of a journal (m), its rate (m/s) and acceleration (m/s^2), in the world's axes."""


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
    gaps: tuple[tuple[Expression, Expression], ...]
    """Penetration (m) and its rate (m/s) of each contact pair."""
    slips: tuple[tuple[Expression, Expression], ...]
    """Slip that each pair's friction follows (m/s), and its rate (m/s^2)."""
    eccentricities: tuple[tuple[Expression, ...], ...]
    """Motion of each pair, as `MOTION` says."""
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
    numbers = view(scene, tracer.number)
    lagrange = formulation == "lagrange"
    coordinates = (
        tuple(f"{body}.{axis}" for body in scene.bodies for axis in ("x", "y", "theta"))
        if lagrange
        else tree.coordinates
    )
    count = len(coordinates)
    speeds = slice(count, 2 * count)
    laws = inner_states(scene)
    states = 2 * count + sum(len(states) for states in laws.values())
    stage = [tracer.variable(f"stage{i}") for i in range(states)]
    own = iter(stage[2 * count :])
    inner = {name: list(islice(own, len(states))) for name, states in laws.items()}
    time = tracer.variable("stage_time")
    driven = {
        name: tracer.variable(f"phase{k}") + numbers.drivers[name].clock_rate * time
        for k, name in enumerate(scene.drivers)
    }
    for k, name in islice(enumerate(clocks(scene)), len(scene.drivers), None):
        driven[name] = tracer.variable(f"phase{k}") + time
    if lagrange:  # here a driven angle is a coordinate, which goes on turning
        for k, (name, driver) in enumerate(scene.drivers.items()):
            if isinstance(driver, SteadyDriver):
                driven[name] = driven[name] + tracer.variable(f"wound{k}")
    modes = {name: tracer.variable(f"mode{j}") for j, name in enumerate(tree.pairs)}
    rates = {name: tracer.hold(f"impact_rate{j}") for j, name in enumerate(tree.pairs)}

    mechanism: LagrangeMechanism | ReducedMechanism
    loops, corrections = None, []
    windings: dict[str, Expression] = {}
    if lagrange:
        mechanism = LagrangeMechanism(scene, numbers, stage[:count], stage[speeds], driven)
        motion = observed = mechanism.motion(modes, rates, inner)
    else:
        position = dict(zip(coordinates, stage[:count], strict=True))
        speed = dict(zip(coordinates, stage[speeds], strict=True))
        windings = _windings(scene, tree, tracer)
        mechanism = ReducedMechanism(tree, numbers, position, speed, driven, windings)
        motion = mechanism.motion(modes, rates, inner)
        known = [tracer.variable(f"slope{count + i}") for i in range(count)]
        observed = mechanism.motion(modes, rates, inner, known)
        if tree.closing:
            loops = mechanism.loops()
            corrections = _corrections(mechanism, loops)
    lift = tracer.lift
    channels = {name: lift(value) for name, value in channel_values(numbers, observed).items()}
    for body, wound in windings.items():
        channels[f"{body}.theta"] = channels[f"{body}.theta"] + wound
    channels["stored"] = lift(stored_energy(observed))
    accelerations = tuple(lift(a) for a in motion.accelerations)
    inner_rates = tuple(lift(r) for found in motion.contacts.values() for r in found.inner_rates)
    along = {f"stage{i}": stage[count + i] for i in range(count)}
    along |= {f"stage{count + i}": a for i, a in enumerate(accelerations)}
    derivative = Derivative(along | {"stage_time": tracer.constant(1.0)})
    slips = [lift(found.rubbing_slip) for found in motion.contacts.values()]
    return Equations(
        tracer,
        coordinates,
        tuple(scene.drivers),
        tuple(clocks(scene)),
        tree.pairs,
        accelerations,
        inner_rates,
        tuple(lift(rate) for rate in ledger_rates(numbers, motion).values()),
        tuple(
            (lift(found.penetration), lift(found.penetration_rate))
            for found in motion.contacts.values()
        ),
        tuple((slip, derivative(slip)) for slip in slips),
        tuple(
            _path(tracer, found.eccentricity, found.eccentricity_rate, derivative)
            for found in motion.contacts.values()
        ),
        tuple(found.enclosure for found in motion.contacts.values()),
        channels,
        loops,
        tuple(lift(multiplier) for multiplier in motion.multipliers),
        tuple(lift(correction) for correction in corrections),
        knots_on_path([*accelerations, *inner_rates], derivative),
    )


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
    tracer: Tracer, position: Pair, rate: Pair, derivative: Derivative
) -> tuple[Expression, ...]:
    """Return position, rate and acceleration of a journal's centre."""
    rates = [tracer.lift(part) for part in rate]
    positions = [tracer.lift(part) for part in position]
    return (*positions, *rates, *(derivative(part) for part in rates))


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


def slopes(equations: Equations) -> list[tuple[str, Expression]]:
    """Return what every stage of a step needs: (slot name, expression).

    The slopes of the coordinates are the stage's speeds and need not be written.
    """
    return [(f"slope{i}", rate) for i, rate in equations.slopes]


def ledger_slopes(equations: Equations) -> list[tuple[str, Expression]]:
    """Return the rates of the ledger's terms, which the lanes of `KEEPS_LEDGER` need."""
    return [(f"ledger{i}", rate) for i, rate in enumerate(equations.ledger)]


def right_hand_side(equations: Equations) -> list[tuple[str, Expression]]:
    """Return what is needed where a step ends: slopes, gaps, slips, journals."""
    count = len(equations.coordinates)
    speeds = [equations.tracer.variable(f"stage{count + i}") for i in range(count)]
    outputs = [(f"slope{i}", speed) for i, speed in enumerate(speeds)] + slopes(equations)
    for j, (gap, rate) in enumerate(equations.gaps):
        outputs += [(f"gap{j}", gap), (f"gap_rate{j}", rate)]
    for j, (slip, rate) in enumerate(equations.slips):
        outputs += [(f"slip{j}", slip), (f"slip_rate{j}", rate)]
    for j, path in enumerate(equations.eccentricities):
        outputs += [(f"eccentricity{len(MOTION) * j + k}", part) for k, part in enumerate(path)]
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
