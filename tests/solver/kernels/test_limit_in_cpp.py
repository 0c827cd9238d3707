"""The press in C++ that kernels are measured beside: it computes the product's motion."""

from dataclasses import replace

import numpy as np
import pytest

from benchmarks.limit.cases import PRESS
from benchmarks.limit.numbers import mechanism, presses
from benchmarks.limit.product import WAYS, Measured
from benchmarks.limit.program import WIDTHS, Program, compiler
from benchmarks.limit.table import PRODUCT, ROWS, WHEEL, C, table
from benchmarks.limit.turns import take_turns
from jointplay.solver.lanes.bundle import Bundle

CHECKED = 0.01
"""s: one or two contacts have begun in each of the first eight presses."""


@pytest.mark.skipif(compiler() is None, reason="There is no C++ compiler.")
def test_cpp_computes_the_motion_of_the_product_at_every_width(tmp_path):
    case = replace(PRESS, parameters=PRESS.parameters[::7])
    problems = case.problems(periods=CHECKED / case.period)
    kernel = case.kernel()
    bundle = Bundle(kernel, problems[:8], watch=False)
    while bundle.advance(10_000):
        pass
    lanes = [bundle.lane(i) for i in range(8)]
    for width, exact in (*((each, False) for each in WIDTHS), (4, True)):
        runs = presses(kernel, problems)  # more of them than there are lanes
        assert len(runs) == 10
        Program(width, tmp_path, exact=exact).advance(mechanism(problems[0].scene), runs)
        for run, lane in zip(runs[:8], lanes, strict=True):
            assert np.max(np.abs(run["y"] - lane["y"]) * lane["weight"]) < 10.0  # tolerances
            assert run["onsets"] == lane.run["onsets"] > 0
            assert abs(run["accepted"] - lane.steps) <= 5
        assert np.all(runs["time"] == CHECKED)


def measured(*milliseconds: float) -> list[Measured]:
    return [Measured(1e-3 * each, 50.0, 2.0) for each in milliseconds]


def test_the_table_has_ratios_by_turn_and_the_goals_of_those_that_are_there():
    assert {row.way for row in ROWS} == set(WAYS)
    ours = {"study": measured(2.2, 4.4, 6.6), "study, extremes": measured(4.4, 6.6, 13.2)}
    limit = {"study": [Measured(1e-3 * each, 40.0, 2.0) for each in (2.0, 4.0, 6.0)]}
    lines = list(table({C: limit, PRODUCT: ours, WHEEL: {"study": measured(4.4, 8.8, 13.2)}}))
    assert len(lines) == 3
    ratios = lines[1].split("revolution")[1].split()
    shown = ["2.20", "1.10", "(1.10-1.10)", "0.88", "(0.88-0.88)", "-", "-", "0.50"]
    assert ratios[:8] == shown
    assert lines[1].endswith("1.15 of C")
    assert "2.00 (1.75-2.00)" in lines[2]
    assert lines[2].endswith("2 of bare")
    [alone] = list(table({PRODUCT: {"alone": measured(2.0)}}))[1:]
    assert "of scalar C" not in alone


def test_programs_take_turns_in_both_orders():
    asked = []

    def way(who, name):
        def measure():
            asked.append((who, name))
            return Measured(1.0, 1.0, 1.0)

        return measure

    programs = {who: {"study": way(who, "study")} for who in (C, PRODUCT)}
    programs[PRODUCT]["alone"] = way(PRODUCT, "alone")
    samples = take_turns(programs, 3)
    assert [who for who, name in asked if name == "study"] == [C, PRODUCT, PRODUCT, C, C, PRODUCT]
    assert {name: len(taken) for name, taken in samples[PRODUCT].items()} == {
        "study": 3,
        "alone": 3,
    }
