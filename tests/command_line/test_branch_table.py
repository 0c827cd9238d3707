"""Lines of special orbits: as many digits as the bound leaves, and no unit of pure numbers."""

import pytest

from jointplay.command_line.branch_table import branch_lines
from jointplay.command_line.job_options import fields_of


def told(value: float, bound: float, unit: str = "rad/s") -> str:
    special = [{"label": "LP", "value": value, "bound": bound, "note": "fold"}]
    found = {
        "parameter": "speed",
        "unit": unit,
        "branches": [{"index": 0, "of": "", "special": special}],
    }
    name, line = branch_lines(found)
    assert name == "branch 0"
    return line


@pytest.mark.parametrize(
    ("value", "bound", "written"),
    [
        (31.431426223, 1e-6, "31.431426"),
        (31.431426223, 0.5, "31.4"),  # never less than three
        (31.431426223, 1e-30, "31.431426223"),
        (24.0, 0.0, "24"),
        (0.0, 1e-9, "0"),
        (-31.431426223, 1e-4, "-31.4314"),
    ],
)
def test_a_value_has_the_digits_that_its_bound_leaves(value, bound, written):
    assert told(value, bound) == f"  LP  speed {written} rad/s  fold"


def test_pure_numbers_have_no_unit():
    assert told(0.5, 0.0, "1") == "  LP  speed 0.5  fold"


def test_a_curve_has_both_parameters_and_one_without_orbits_no_line():
    cusp = {"label": "CP", "value": 2.0, "bound": 1e-3, "note": "cusp"}
    curve = {"index": 1, "of": "LP", "special": [cusp | {"second": 0.25, "second_bound": 1e-2}]}
    found = {
        "parameter": "speed",
        "unit": "rad/s",
        "second": "amplitude",
        "second_unit": "m",
        "branches": [curve, {"index": 2, "of": "", "special": []}],
    }
    assert list(branch_lines(found)) == [
        "curve 1 of LP",
        "  CP  speed 2 rad/s  amplitude 0.25 m  cusp",
    ]


def test_a_second_parameter_is_typed_as_the_first_one_is():
    typed = {"branch": ["speed=25:33:120"], "second": "amplitude=1e-3:2e-2:60"}
    assert fields_of(typed) == {
        "kind": "continuation",
        "parameter": "speed",
        "values": {"from": 25, "to": 33, "count": 120},
        "second": {"parameter": "amplitude", "values": {"from": 1e-3, "to": 2e-2, "count": 60}},
    }
