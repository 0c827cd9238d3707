"""Seconds of compiling are known before anything is compiled, and bounded."""

from typing import Any

import pytest

from jointplay.records.failure import LimitExceeded
from jointplay.solver.integrators import AUTO, COARSE, Method
from jointplay.solver.kernels.emit.kernel import compile_kernel
from jointplay.solver.kernels.trace.tracer import MOST_STATEMENTS
from jointplay.solver.kinds import admit
from jointplay.solver.kinds.compilation import (
    LINES,
    SECONDS_PER_LINE,
    check_compilation,
    compile_seconds,
)
from jointplay.solver.mechanics.tree import spanning_tree
from tests.solver.random_mechanisms import chain


def job(scene: dict[str, Any], formulation: str = "reduced") -> Any:
    return admit({"kind": "simulate", "scene": scene, "duration": 0.1, "formulation": formulation})


@pytest.mark.parametrize(
    ("preset", "formulation", "method"),
    [
        ("slider-crank", "reduced", COARSE),
        ("slider-crank", "lagrange", AUTO),
        pytest.param("double-four-bar", "reduced", AUTO, marks=pytest.mark.long),
    ],
)
def test_the_length_of_the_longest_source_is_foreseen(
    preset: str, formulation: str, method: Method
) -> None:
    admitted = job({"preset": preset}, formulation)
    scene = admitted.scene
    kernel = compile_kernel(scene, spanning_tree(scene), formulation, method)
    lines = sum(len(one.lines) for one in kernel.module.sources)
    foreseen = compile_seconds(admitted) / SECONDS_PER_LINE
    assert lines < foreseen < 2.0 * lines


def test_nothing_is_compiled_where_drivers_alone_tell_every_pose() -> None:
    ideal = {"preset": "quick-return", "parameters": {"clearance": 0.0}}
    assert compile_seconds(job(ideal)) == 0.0


def test_equations_that_take_longer_than_allowed_are_refused_with_the_estimate() -> None:
    admitted = job(chain(14).model_dump())
    check_compilation(admitted, 600.0)
    with pytest.raises(LimitExceeded) as refused:
        check_compilation(admitted, 2.0)
    (problem,) = refused.value.problems
    assert problem.pointer == "/scene"
    assert f"{compile_seconds(admitted):.2g} s" in problem.detail
    assert "2 s" in problem.detail


def test_few_bodies_are_compiled_within_any_limit_but_a_short_one() -> None:
    press = job({"preset": "seven-bar-press"})
    check_compilation(press, 600.0)
    with pytest.raises(LimitExceeded):
        check_compilation(press, 1.0)


def test_whatever_is_admitted_is_compiled_within_the_default_limit() -> None:
    """A scene of 96 bodies, all with play, with the most statements of slopes and of channels."""
    most = {"statement": 2 * MOST_STATEMENTS, "state": 6 * 96, "pair": 128}
    seconds = SECONDS_PER_LINE * sum(lines * most[what] for what, lines in LINES.items())
    assert seconds < 600.0 / 5  # a core that four others share
