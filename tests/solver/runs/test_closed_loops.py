"""Loops of ideal joints that move: published digits, closed forms, the other formulation."""

import math

import numpy as np
import pytest

from jointplay.solver.integrators import TSITOURAS5
from jointplay.solver.kernels.emit.kernel import compile_kernel
from jointplay.solver.kernels.emit.tangents import compile_tangents
from jointplay.solver.kinds import admit
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.runs.simulate import Simulation
from jointplay.solver.scene.document import Scene
from tests.solver.closed_loops import (
    four_bars,
    four_bars_angle,
    parallel_cranks,
    parallel_cranks_angle,
)
from tests.solver.completed_runs import Run, run

A_ALONE = {"clearance_B": 0.0}
METHODS = [
    {"tolerance": 1e-9},
    pytest.param({"tolerance": 1e-9, "method": "dormand-prince-853"}, marks=pytest.mark.long),
    pytest.param({"tolerance": 1e-7, "method": "bogacki-shampine"}, marks=pytest.mark.long),
    pytest.param({"tolerance": 1e-7, "method": "rodas"}, marks=pytest.mark.long),
    {"method": "rk4", "step": 1e-3},
]
SPEEDS = -np.geomspace(0.01, 5.0, 40)
"""Speeds of cranks that fall from upright: the slowest take seconds to leave it, the fastest go
round."""


def gaps(found: Run, four_bar: int = 0) -> float:
    """Return how far the coupler and the crank behind it are apart at most, m."""
    (cx, cy, ca), (bx, by, ba) = (
        (found[f"{body}.x"], found[f"{body}.y"], found[f"{body}.theta"])
        for body in (f"C{four_bar}", f"B{four_bar + 1}")
    )
    across = cx + 0.5 * np.cos(ca) - bx - 0.5 * np.cos(ba)
    up = cy + 0.5 * np.sin(ca) - by - 0.5 * np.sin(ba)
    return float(np.hypot(across, up).max())


@pytest.mark.long
def test_the_press_with_play_at_a_alone_has_the_same_motion_in_both_formulations() -> None:
    runs = [
        run(
            "seven-bar-press",
            0.03,
            parameters=A_ALONE,
            tolerance=1e-11,
            formulation=formulation,
            output_step=1e-3,
        )
        for formulation in ("reduced", "lagrange")
    ]
    for name in runs[0].samples:
        if name.split(".")[-1] in ("x", "y", "theta"):
            np.testing.assert_allclose(runs[0][name], runs[1][name], rtol=0, atol=1e-9)
        if name.split(".")[-1] in ("force_x", "force_y"):  # hundreds of N
            np.testing.assert_allclose(runs[0][name], runs[1][name], rtol=0, atol=1e-6)


def test_the_press_with_play_at_a_alone_has_its_stroke_and_keeps_its_ledger() -> None:
    found = run("seven-bar-press", 2.0, parameters=A_ALONE, tolerance=1e-9, output_step=0.01)
    # the digit that two other programs agree on
    assert found.peaks["displacement"].maximum == pytest.approx(0.527614, abs=1e-6)
    energy = found.statistics["energy"]
    assert abs(energy["residual"]) < 1e-8 * energy["gross_work"]


ANGLES = {
    "beta": (15.81077119516, 1139.92030226),
    "Theta": (-15.75637105842, -1424.37929518),
    "gamma": (0.04082224011967, 11.0329119118),
    "Phi": (-0.534730116342, 19.293374107),
    "delta": (0.52440996588, 0.573569914888),
    "Omega": (0.534730116342, -19.293374107),
    "epsilon": (1.048080741042, 0.323179149283),
}
"""Andrews' squeezer at 0.03 s. DOP853 and Radau in the coordinates of the problem's source agree
on them to 5e-12. The published digits are good to 1.4e-9."""


@pytest.mark.parametrize(
    ("job", "within"),
    [
        pytest.param({"tolerance": 1e-12}, 1e-10, id="explicit"),
        pytest.param(
            {"tolerance": 1e-9, "method": "rodas"}, 1e-9, id="implicit", marks=pytest.mark.long
        ),
        pytest.param(
            {"tolerance": 1e-9, "formulation": "lagrange"},
            1e-9,
            id="multipliers",
            marks=pytest.mark.long,
        ),
    ],
)
def test_andrews_squeezer_gets_to_the_digits_of_other_programs(
    job: dict[str, object], within: float
) -> None:
    found = run("andrews-squeezer", 0.03, output_step=0.03, **job)
    for quantity, column in (("theta", 0), ("omega", 1)):
        one, two, three, four, five, six, seven = found.last(
            *(f"K{i}.{quantity}" for i in range(1, 8))
        )
        relative = (one, two - one, three, four - five, five, six - seven, seven)
        expected = [digits[column] for digits in ANGLES.values()]
        # speeds are up to 1400 times as large as angles
        scale = max(1.0, max(map(abs, expected)) / 16.0)
        np.testing.assert_allclose(relative, expected, rtol=0, atol=within * scale)


@pytest.mark.parametrize(
    "speed",
    [pytest.param(v, marks=() if i % 13 == 0 else pytest.mark.long) for i, v in enumerate(SPEEDS)],
)
def test_a_double_four_bar_keeps_its_assembly_where_others_meet_it(speed: float) -> None:
    """Below 1e-9 a step may end where links lie too flat for doubles to tell assemblies apart."""
    tolerance = 1e-8
    found = run(four_bars(2, float(speed)), 10.0, tolerance=tolerance, output_step=0.5)
    angle = found["B0.theta"][-1]
    low, expected, high = (four_bars_angle(2, float(speed) + d, 10.0) for d in (-1e-6, 0.0, 1e-6))
    tip = math.hypot(math.cos(angle) - math.cos(expected), math.sin(angle) - math.sin(expected))
    # slow starts pass the upright pose again, slowly: what a speed off by 30 tolerances would do
    assert tip < max(1e-6, 30 * tolerance * abs(high - low) / 2e-6)
    assert gaps(found) < 1e-9


@pytest.mark.parametrize("job", METHODS, ids=str)
def test_every_method_ends_its_steps_where_loops_are_closed(job: dict[str, object]) -> None:
    found = run(four_bars(2, -1.0), 2.0, output_step=1e-3, **job)
    # the error of a tolerance of 1e-7 over some thousand steps; for steps of 1e-3, h^4
    assert found["B2.theta"][-1] == pytest.approx(four_bars_angle(2, -1.0, 2.0), abs=1e-5)
    # within steps the gap is their error
    assert gaps(found) < 1e-6
    if job.get("step") == 1e-3:  # where each of them ends, the error's square
        assert gaps(found) < 1e-13


@pytest.mark.parametrize("count", [2, *(pytest.param(n, marks=pytest.mark.long) for n in (3, 40))])
def test_many_four_bars_swing_as_one_pendulum(count: int) -> None:
    found = run(four_bars(count, -1.0), 3.0, tolerance=1e-9, output_step=0.1)
    expected = four_bars_angle(count, -1.0, 3.0)
    for crank in (0, count):
        assert found[f"B{crank}.theta"][-1] == pytest.approx(expected, abs=1e-7)
    assert gaps(found, count - 1) < 1e-9


@pytest.mark.parametrize("count", [3, pytest.param(5, marks=pytest.mark.long)])
def test_redundant_cranks_carry_their_plate(count: int) -> None:
    found = run(parallel_cranks(count), 5.0, tolerance=1e-9, output_step=0.01)
    angle = parallel_cranks_angle(count, 5.0)
    assert found["B0.theta"][-1] == pytest.approx(angle, abs=1e-7)
    assert np.abs(found["plate.theta"]).max() < 1e-9
    energy = found["energy.kinetic"] + found["energy.potential"]
    np.testing.assert_allclose(energy, energy[0], rtol=0, atol=1e-7 * 40.0)  # of 40 J
    # forces are smooth, though how the cranks share them is a matter of convention
    force = found["P1.force_y"]
    third = np.abs(np.diff(force, 3)).max()
    assert third < 1e-3 * np.abs(force).max()


def test_multipliers_carry_a_plate_on_redundant_cranks_too() -> None:
    job = {"tolerance": 1e-9, "output_step": 0.01}
    reduced, lagrange = (
        run(parallel_cranks(3), 0.4, formulation=formulation, **job)  # before they lie flat
        for formulation in ("reduced", "lagrange")
    )
    for channel in ("B0.theta", "plate.y", "B2.omega"):
        np.testing.assert_allclose(reduced[channel], lagrange[channel], rtol=0, atol=1e-7)


def test_a_certificate_follows_closed_loops() -> None:
    scene = four_bars(2, -1.0)
    simulation = Simulation(admit({"kind": "simulate", "scene": scene, "duration": 5.0}))
    for _ in simulation.slices():
        pass
    certificate = simulation.certificate()
    assert certificate is not None
    facts = certificate.facts
    assert facts["horizon"] == 5.0
    assert all(lane["complete"] for lane in facts["lanes"])
    residuals = [lane["energy_residual"] for lane in facts["lanes"]]
    beside = [lane["energy_residual"] for lane in facts["lanes"] if lane["perturbed"]]
    assert beside
    assert residuals[0] not in beside
    # loops of starts beside the scene's are closed, too: they keep their energy, of 40 J
    assert max(map(abs, residuals)) < 1e-5
    violation = facts["constraint_violation"]
    assert 0.0 < violation["position"] < 1e-6
    assert facts["exponent"] is not None


def test_a_tangent_of_closed_loops_is_a_motion_that_they_allow() -> None:
    """Upright and at rest, three cranks and two couplers are one pendulum on its head."""
    scene = Scene.model_validate(four_bars(2, 0.0))
    kernel = compile_kernel(scene, spanning_tree(scene), "reduced", TSITOURAS5)
    duration = 6.0
    problem = LaneProblem(scene, duration, 1e-9, duration, 0, 0, 0.0)
    bundle = Bundle(kernel, [problem], watch=False, tangents=compile_tangents(kernel))
    while bundle.advance(10**6):
        pass
    tangent = dict(zip(kernel.coordinates, bundle.lane(0)["tangent"], strict=False))
    turns = [tangent[f"B{i}.theta"] for i in range(3)]
    np.testing.assert_allclose(turns, turns[0], rtol=1e-12)
    np.testing.assert_allclose([tangent["C0.theta"], tangent["C1.theta"]], 0.0, atol=1e-12)
    rate = math.sqrt(3.5 * 9.81 / 3.0)
    speed = bundle.lane(0)["tangent"][len(tangent)]
    # growing and dying directions have parted by exp(2 * 6 s * 3.4 / s)
    assert speed / turns[0] == pytest.approx(rate, rel=1e-9)
