"""Sines of stages that are turned on from those where the step starts."""

import math

import numpy as np
import pytest

from jointplay.records.arrays import Floats
from jointplay.solver.kernels.emit.emit import FixedNodes, Tape
from jointplay.solver.kernels.emit.module import Module, load
from jointplay.solver.kernels.emit.tangents import compile_tangents
from jointplay.solver.kernels.emit.turned_sines import FARTHEST, Angle, TurnedSines
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.layout import Layout
from jointplay.solver.kernels.target import own_target
from jointplay.solver.kernels.trace.tracer import Tracer
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.scene.document import Scene
from tests.solver.readable_mechanics import preset

ROUNDED = 4.5e-16
"""Two units in the last place of 1: those of sines at the start, and sums of three terms."""
LANES = own_target().lanes
STARTS = ("angle_start", "sine_start", "cosine_start")
CONTACT = {"contact": {"law": "lankarani-nikravesh", "stiffness": 1e8, "restitution": 0.5}}


@pytest.fixture(scope="module")
def turning() -> tuple[Layout, Module]:
    """Return sines of one angle: at the start (`sines_at_start`) and of a stage (`sines`)."""
    layout, angle = Layout(), Tracer().variable("stage0")
    layout.add("time", "stage_time", "y0", "stage0", "sine", "cosine")
    sine, cosine = angle.sine_cosine()
    turned = TurnedSines([Angle(angle, sine, cosine)])
    turned.allocate(layout)
    tape = Tape(layout)
    turned.turn(tape)
    tape.store([("sine", sine), ("cosine", cosine)])
    sources = turned.source(layout, FixedNodes(layout)), tape.function("sines")
    return layout, load(sources, LANES)


def sines(turning: tuple[Layout, Module], start: Floats, angle: Floats) -> Floats:
    """Return (2, lanes) sine and cosine of angles, whose steps start at others, rad."""
    layout, module = turning
    work = np.zeros((layout.size, LANES))
    work[layout["y0"]], work[layout["stage0"]] = start, angle
    module.sines_at_start(work)
    module.sines(work)
    return work[[layout["sine"], layout["cosine"]]]


def test_turned_sines_are_those_of_the_angle(turning: tuple[Layout, Module]) -> None:
    random, turned = np.random.default_rng(5), 0
    for _ in range(500):
        start = random.choice([0.0, 50.0]) * random.uniform(-1.0, 1.0, LANES)
        turn = random.choice([1e-9, 1e-3, 0.5, 0.999]) * FARTHEST * random.uniform(-1.0, 1.0, LANES)
        angle = start + turn
        found = sines(turning, start, angle)
        assert (abs(found - [np.sin(angle), np.cos(angle)]) <= ROUNDED).all()
        turned += (found != sines(turning, angle, angle)).sum()
    assert turned > 100  # not evaluated anew


def test_who_turns_far_has_sines_evaluated_anew_and_changes_nothing_beside(
    turning: tuple[Layout, Module],
) -> None:
    start, turns = np.linspace(0.3, 1.7, LANES), np.linspace(1e-3, 1e-2, LANES)
    alone = sines(turning, start, start + turns)
    for far in (1.001 * FARTHEST, 3.0, 1e3, math.inf, math.nan):
        angle = start + turns
        angle[0] = start[0] + far
        found = sines(turning, start, angle)
        assert np.array_equal(found[:, 1:], alone[:, 1:])
        anew = sines(turning, angle, angle)
        assert np.array_equal(found[:, 0], anew[:, 0], equal_nan=True)


def test_sines_that_a_step_leaves_are_those_where_the_next_one_starts() -> None:
    scenes = [preset("seven-bar-press", clearance=float(c)) for c in np.linspace(3e-4, 6e-4, 8)]
    kernel = ready_kernel(scenes[0], "reduced", "tsitouras")
    bundle = Bundle(kernel, [LaneProblem(one, 1e3, 1e-6, 1e3, 0, 0, 0.0) for one in scenes])
    for attempts in (500, 1, 1, 1):
        bundle.advance(attempts)
        work = bundle.groups[0].work.copy()
        rows = np.concatenate(
            [np.arange(kernel.layout.size)[kernel.layout.block(name)] for name in STARTS]
        )
        kept = work[rows]
        work[rows] = 0.0
        kernel.module.sines_at_start(work)
        assert np.array_equal(work[rows], kept)
        assert (kept != 0.0).all()


def test_slopes_of_a_press_and_of_its_tangents_take_turned_sines() -> None:
    kernel = ready_kernel(preset("seven-bar-press"), "reduced", "tsitouras")
    for module, name in (
        (kernel.module, "slopes"),
        (compile_tangents(kernel).module, "carried_slopes"),
    ):
        (tape,) = (one.lines for one in module.sources if one.name == name)
        assert sum(" either " in line for line in tape) == 2 * 5  # two cranks, three links


def with_a_hand(pieces: int) -> Scene:
    """Return a journal that four forces over x pull, and one that turns with a driven hand."""
    origin = {"points": {"O": [0.0, 0.0]}}
    ends = {"first": "ground.O", "second": "ball.O"}
    force = {"type": "force", "magnitude": 1.0, "direction": [1.0, 0.0]}
    over = {"over": {"quantity": "x", **ends}}
    knots = np.linspace(-2e-3, 2e-3, pieces + 1).tolist()
    pull = {
        "type": "piecewise-polynomial",
        "knots": knots,
        "coefficients": [  # of one cubic, whatever the pieces
            [1.0 + x * (1e2 + x * (1e5 + x * 1e8)), 1e2 + x * (2e5 + x * 3e8), 1e5 + x * 3e8, 1e8]
            for x in knots[:-1]
        ],
        "outside": "held",
    }
    document = {
        "name": "hand",
        "ground": origin,
        "bodies": {name: {"mass": 1.0, "inertia": 1.0} | origin for name in ("ball", "hand")},
        "joints": {
            "J": {"type": "revolute", "bearing": "ground.O", "journal": "ball.O"}
            | {"clearance": {"radial_clearance": 1e-3, "bearing_radius": 0.01} | CONTACT},
            "pivot": {"type": "revolute", "bearing": "ground.O", "journal": "hand.O"},
        },
        "drivers": {"motor": {"joint": "pivot", "speed": 20.0}},
        "forces": {
            **{f"pull{i}": force | ends | over | {"course": pull} for i in range(4)},
            "turning": force | {"first": "hand.O", "second": "ball.O", "axes": "first"},
        },
    }
    return Scene.model_validate(document)


def test_an_angle_that_is_traced_behind_long_functions_is_kept_as_any_other() -> None:
    ends = []
    for pieces in (1, 60):
        kernel = ready_kernel(with_a_hand(pieces), "reduced", "tsitouras")
        bundle = Bundle(kernel, [LaneProblem(with_a_hand(pieces), 1.0, 1e-9, 1.0, 0, 0, 0.0)])
        bundle.advance(100_000)
        ends.append(bundle.lane(0)["y"].copy())
    assert ends[1] == pytest.approx(ends[0], rel=1e-5)
