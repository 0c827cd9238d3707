"""Branches past grazing: a map with the square root of an impact, and a hard stop."""

import math
from functools import cache

import numpy as np
import pytest

from benchmarks.continuation import branch, free_section
from jointplay.records.arrays import Floats
from jointplay.records.branch import Branch
from jointplay.solver.continuation.branch import Row
from tests.solver.continuation.known_maps import rows_of
from tests.solver.continuation.oscillator import free_multipliers, grazing

HARD = 1e11
"""Stiffness of a stop, N/m^1.5, at which grazing is a corner for differences."""


def striking(
    kick: float, x: float, values: tuple[float, float], low: float, together: int = 1
) -> list[Row]:
    """Return the branch of x -> x/2 + a + kick v from x, where v = sqrt(x) is an impact's speed.

    Without it x = 2 a, with it a = v^2 / 2 - kick v; they meet at 0. `together` : impacts at once.
    """

    def formula(state: Floats, a: float, *_second: float) -> list[float]:
        return [0.5 * state[0] + a + kick * math.sqrt(max(state[0], 0.0)), 0.0]

    def speed(state: Floats, *_values: float) -> float:
        return math.sqrt(state[0]) if state[0] > 0.0 else math.nan

    return rows_of(
        formula,
        [x, 0.0],
        values,
        low=low,
        pairs=1,
        impacts=lambda state, *_values: together * int(state[0] > 0.0),
        nearest=lambda state, *_values: math.nan if state[0] > 0.0 else float(state[0]),
        speed=speed,
    )


@pytest.mark.parametrize(
    ("kick", "x", "values", "low", "known"),
    [
        # turns back at grazing, then at the fold v = 1
        (1.0, -0.8, (-0.4, 0.2), -0.8, [("GR", 0.0), ("LP", -0.5)]),
        # goes on, unstable up to v = 1/3
        (-1.0, -0.6, (-0.3, 0.6), -0.6, [("GR", 0.0), ("PD", 7.0 / 18.0)]),
        # the impact ends
        (1.0, 0.25, (-0.375, 0.2), -0.8, [("GR", 0.0)]),
        (-1.0, 0.25, (0.625, -0.3), 0.7, [("PD", 7.0 / 18.0), ("GR", 0.0)]),
    ],
)
def test_a_branch_goes_on_with_another_number_of_impacts(
    kick: float, x: float, values: tuple[float, float], low: float, known: list[tuple[str, float]]
) -> None:
    rows = striking(kick, x, values, low)
    found = [row for row in rows if row.label not in ("", "EP")]
    assert [row.label for row in found] == [label for label, _ in known]
    for row, (_, at) in zip(found, known, strict=True):
        assert abs(row.orbit.value - at) <= row.bound + 1e-9
        assert row.bound < 1e-5
    assert rows[-1].label == "EP"
    (touch,) = (row for row in found if row.label == "GR")
    assert ("begins: 0 before, 1 behind" in touch.note) == (x < 0.0)
    assert ("turns back" in touch.note) == (kick > 0.0)
    for row in rows:
        at = float(row.orbit.section.state[0])
        v = math.sqrt(max(at, 0.0))
        assert row.orbit.value == pytest.approx(0.5 * at - kick * v, abs=3e-6)
    lengths = [row.length for row in rows]
    assert lengths == sorted(lengths)


def test_where_two_impacts_begin_at_once_the_branch_ends_and_says_what_was_sought() -> None:
    rows = striking(1.0, -0.8, (-0.4, 0.2), -0.8, together=2)
    assert rows[-1].label == "MX"
    assert abs(rows[-1].orbit.value) < 1e-5
    assert "because an impact begins or ends here (grazing); try a softer contact" in rows[-1].note
    assert "an orbit with one impact more was sought, but another impact begins" in rows[-1].note


@cache
def struck() -> Branch:
    """Return a branch that begins without impacts, next to the higher speed of grazing."""
    values = {"from": 31.5, "to": 24.0, "count": 100}
    start = {"at": 24.5, "state": free_section(24.5), "settle": 0}
    return branch(HARD, values=values, largest_step=0.06, **start)


def test_past_grazing_a_slow_impact_makes_the_motion_unstable_up_to_a_fold() -> None:
    found = struck()
    assert [one.label for one in found.special] == ["EP", "GR", "LP", "EP", "EP"]
    _, touch, fold, end, _ = found.special
    assert abs(touch.value - grazing()[1]) <= touch.bound < 3e-6
    assert "turns back" in touch.note
    assert fold.value == pytest.approx(31.4314262200, rel=1e-3)  # 5e-4 by the time of contact
    assert end.value == pytest.approx(24.0)
    for name, values in {"impacts": [0, 1, 1], "unstable": [0, 1, 0]}.items():
        whole = found.column(name)
        parts = np.split(whole[: end.row + 1], [touch.row + 1, fold.row])
        assert [set(part.tolist()) for part in parts] == [{one} for one in values]


def test_down_to_grazing_the_impact_ends_and_the_motion_without_it_goes_on() -> None:
    whole = struck()
    unstable = np.flatnonzero(whole.column("unstable") == 1.0).tolist()
    saddle = next(row for row in unstable if whole.column("value")[row] > 24.8)
    state = [float(whole.column(f"{kind}.mass.s")[saddle]) for kind in ("state", "rate")]
    values = {"from": float(whole.column("value")[saddle]), "to": 24.0, "count": 60}
    found = branch(HARD, values=values, state=state, settle=0)
    assert [one.label for one in found.special] == ["EP", "GR", "EP"]
    touch = found.special[1]
    assert abs(touch.value - grazing()[1]) <= touch.bound < 3e-6
    assert "an impact ends: 1 before, 0 behind" in touch.note
    assert set(found.column("impacts")[touch.row + 1 :].tolist()) == {0.0}
    for row in range(touch.row + 1, len(found.column("value"))):
        known = free_multipliers(float(found.column("value")[row]))[0]
        assert found.column("multiplier_1.real")[row] == pytest.approx(known.real, abs=1e-7)


def test_at_the_lower_speed_the_branch_goes_on_through_the_corner() -> None:
    values = {"from": 14.1, "to": 14.4, "count": 40}
    found = branch(1e12, values=values, state=free_section(14.1), settle=0)
    assert [one.label for one in found.special] == ["EP", "GR", "EP"]  # no doubling in the corner
    touch = found.special[1]
    assert abs(touch.value - grazing()[0]) <= touch.bound + 1e-7  # of a stop so hard
    assert "turns back" not in touch.note
    first, second = (found.column(f"multiplier_{k}.real")[touch.row + 1 :] for k in (1, 2))
    assert (first < -1.0).all()
    # each impact leaves the share 0.8 of its speed, once it is faster than what the stop gives way
    lost = 0.64 * math.exp(-4.0 * math.pi / found.column("value")[-1])
    assert first[-1] * second[-1] == pytest.approx(lost, rel=0.01)
