"""Lines of special orbits: as many digits as the bound leaves, and no unit of pure numbers."""

import pytest

from jointplay.command_line.branch_table import branch_lines


def told(value: float, bound: float, unit: str = "rad/s") -> str:
    special = [{"label": "LP", "value": value, "bound": bound, "note": "fold"}]
    found = {
        "parameter": "speed",
        "unit": unit,
        "branches": [{"index": 0, "special": special}],
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
