"""Labels, places and bounds of special orbits, of maps whose bifurcations are known exactly."""

import math
from collections.abc import Sequence

import numpy as np
import pytest

from jointplay.records.arrays import Floats
from jointplay.solver.continuation.branch import Row, both_ways
from jointplay.solver.continuation.multipliers import unstable
from jointplay.solver.continuation.plan import Reach
from tests.solver.continuation.known_maps import Formula, rows_of

B = 0.3


def henon(state: Floats, a: float) -> list[float]:
    x, y = state.tolist()
    return [a - x * x + B * y, x]


def delayed_logistic(state: Floats, a: float) -> list[float]:
    x, y = state.tolist()
    return [a * x * (1.0 - y), x]


def pitchfork(state: Floats, a: float) -> list[float]:
    (x,) = state.tolist()
    return [a * x - x**3]


def area_preserving(state: Floats, a: float) -> list[float]:
    x, y = state.tolist()
    return [a - x * x - y, x]


def neutral_saddle(state: Floats, a: float) -> list[float]:
    return [2.0 * float(state[0]), a * float(state[1])]


def circle(state: Floats, a: float) -> list[float]:
    (x,) = state.tolist()
    return [x + 0.3 * (x * x + a * a - 1.0)]


def two_doublings(state: Floats, a: float) -> list[float]:
    x, y = state.tolist()
    return [-a * x, -(a + 1e-4) * y]


def bent(state: Floats, a: float) -> list[float]:
    (x,) = state.tolist()
    return [-a * np.sin(1000.0 * x) / 1000.0]


def told(row: Row) -> tuple[str, str]:
    return row.label, row.note


@pytest.mark.parametrize(
    ("formula", "start", "values", "known"),
    [
        # the stable fixed point, down to the fold and back up on the saddle
        (henon, [0.3, 0.3], (0.2, -0.5), [("LP", -((1.0 - B) ** 2) / 4.0)]),
        (henon, [0.3, 0.3], (0.2, 0.6), [("PD", 3.0 * (1.0 - B) ** 2 / 4.0)]),
        (delayed_logistic, [0.4, 0.4], (1.7, 2.3), [("NS", 2.0)]),
        (pitchfork, [0.0], (0.5, 1.4), [("BP", 1.0)]),
        (neutral_saddle, [0.0, 0.0], (0.3, 0.8), []),
        (two_doublings, [0.0, 0.0], (0.9, 1.1), [("PD", 0.9999), ("PD", 1.0)]),
    ],
)
def test_what_bifurcates_has_its_label_at_its_place_within_its_bound(
    formula: Formula,
    start: Sequence[float],
    values: tuple[float, float],
    known: list[tuple[str, float]],
) -> None:
    rows = rows_of(formula, start, values)
    found = [row for row in rows if row.label not in ("", "EP")]
    assert [row.label for row in found] == [label for label, _ in known]
    for row, (_, at) in zip(found, known, strict=True):
        assert abs(row.orbit.value - at) <= row.bound + 1e-12
        assert row.bound < 1e-5
    assert rows[-1].label == "EP"


def test_pairs_that_stay_on_the_unit_circle_pass_nothing_by_their_errors() -> None:
    # elliptic until it doubles where x is 1; before, the pair stays on the circle
    rows = rows_of(area_preserving, [0.1, 0.1], (0.2, 3.3))
    (doubling,) = [row for row in rows if row.label not in ("", "EP")]
    assert doubling.label == "PD"
    assert abs(doubling.orbit.value - 3.0) <= doubling.bound + 1e-12
    counts = [unstable(row.orbit.multipliers, within=row.orbit.slack) for row in rows]
    at = rows.index(doubling)
    assert not any(counts[:at])
    assert all(counts[at + 1 :])


def test_a_branch_that_closes_is_gone_round_once() -> None:
    rows = rows_of(circle, [-0.8], (0.6, 2.0), low=-2.0)
    assert told(rows[-1]) == ("EP", "the branch has closed")
    folds = [row.orbit.value for row in rows if row.label == "LP"]
    assert folds == [pytest.approx(1.0, abs=1e-7), pytest.approx(-1.0, abs=1e-7)]
    start = rows[0].orbit
    ways = [(start, sign * np.array([0.0, 1.0])) for sign in (1.0, -1.0)]
    both = list(both_ways(rows[0], ways, Reach(-2.0, 2.0, 400, 0.03)))
    assert both[-1].note == rows[-1].note
    lengths = [row.length for row in both]
    assert lengths == sorted(lengths)
    # once round, where the parameter counts in widths of 1.4
    circumference = sum(
        np.hypot(np.cos(t), np.sin(t) / 1.4) for t in np.linspace(0.0, 2.0 * np.pi, 1000)[1:]
    )
    assert max(lengths) == pytest.approx(circumference * 2.0 * np.pi / 999.0, rel=0.03)


def test_impacts_begin_and_end_where_their_number_changes() -> None:
    rows = rows_of(
        pitchfork, [0.0], (0.1, 0.9), impacts=lambda _state, a: int(a > 0.31) + 2 * (a < 0.32)
    )
    found = [row for row in rows if row.label == "GR"]
    assert [row.note for row in found] == [
        "an impact begins: 2 before, 3 behind",
        "impacts end: 3 before, 1 behind",
    ]
    for row, at in zip(found, (0.31, 0.32), strict=True):
        assert abs(row.orbit.value - at) <= row.bound < 1e-8


@pytest.mark.parametrize("has_friction", [True, False])
def test_a_branch_that_is_lost_says_what_to_try(has_friction: bool) -> None:
    def ends(state: Floats, a: float) -> list[float]:
        return [a * float(state[0]) if a < 0.5 else math.nan]

    told = {"phases": lambda _state, _a: (0, 1)} if has_friction else {}
    *_, last = rows_of(ends, [0.0], (0.1, 0.9), **told)
    friction = "a wider ramp of friction, " if has_friction else ""
    assert last.label == "MX"
    assert last.note.endswith(f"; try {friction}a smaller tolerance or a smaller 'largest_step'")


@pytest.mark.parametrize(
    ("speed", "words"),
    [(1e-3, "next to grazing: an impact has 0.001 m/s; try a softer"), (0.5, "try a smaller")],
)
def test_a_branch_that_is_lost_with_a_slow_impact_says_that(speed: float, words: str) -> None:
    def ends(state: Floats, a: float, *_second: float) -> list[float]:
        return [a * float(state[0]) if a < 0.5 else math.nan, 0.0]

    *_, last = rows_of(
        ends,
        [0.0, 0.0],
        (0.1, 0.9),
        impacts=lambda *_at: 1,
        pairs=1,
        speed=lambda *_at: speed,
    )
    assert last.label == "MX"
    assert words in last.note


def test_a_branch_that_is_lost_with_an_impact_says_that_it_may_lie_on_the_section() -> None:
    def strikes(state: Floats, a: float, *_second: float) -> list[float]:
        return [0.5 * float(state[0]) + a + (a > 0.5), 0.0]

    def impacts(_state: Floats, a: float, *_second: float) -> int:
        return 1 + (a > 0.5)

    *_, last = rows_of(strikes, [0.2, 0.0], (0.1, 0.9), impacts=impacts, pairs=1)
    assert last.label == "MX"
    assert (
        "or lies on the section; try a softer contact, or another phase of the drive" in last.note
    )


def test_lengths_behind_the_start_are_negative_and_orbits_are_counted() -> None:
    rows = rows_of(pitchfork, [0.0], (0.9, 0.1), sense=-1.0, orbits=5)
    assert len(rows) == 5
    assert told(rows[-1]) == ("EP", "5 orbits were asked for")
    lengths = [row.length for row in rows]
    assert lengths == sorted(lengths, reverse=True)
    assert lengths[0] < 0.0


def test_bounds_and_errors_cover_what_differences_err_by() -> None:
    rows = rows_of(bent, [0.0], (0.5, 1.4))
    (doubling,) = [row for row in rows if row.label == "PD"]
    assert 1e-6 < abs(doubling.orbit.value - 1.0) <= doubling.bound < 1e-3
    for row in rows:
        away = abs(row.orbit.multipliers[0] + row.orbit.value)
        assert 1e-6 < away <= row.orbit.error < 1e-3


def test_newtons_method_does_not_ask_for_runs_far_from_the_range() -> None:
    asked = []

    def steep(state: Floats, a: float) -> list[float]:
        asked.append(a)
        return [float(state[0]) - np.tanh(300.0 * (float(state[0]) - a * a))]

    rows = rows_of(steep, [0.01], (0.1, 2.1), step=0.5)
    assert told(rows[-1]) == ("EP", "end of the range")
    assert -2.0 < min(asked) < max(asked) < 4.2


def test_differences_are_finer_only_where_their_error_leaves_stability_open() -> None:
    def finely_bent(state: Floats, a: float) -> list[float]:
        (x,) = state.tolist()
        return [-a * np.sin(2e4 * x) / 2e4]

    rows = rows_of(finely_bent, [0.0], (0.5, 1.4))
    scales = {row.orbit.scale for row in rows if row.orbit.value < 0.8}
    assert scales == {1.0}
    assert {row.orbit.scale for row in rows if row.orbit.value > 0.9995} == {0.03}
    (doubling,) = [row for row in rows if row.label == "PD"]
    assert abs(doubling.orbit.value - 1.0) <= doubling.bound < 1e-3


def test_where_newtons_method_finds_nothing_a_shorter_step_is_tried_not_finer_differences() -> None:
    asked = []

    def sharp(state: Floats, a: float) -> list[float]:
        asked.append(a)
        x = float(state[0])
        return [x + 0.005 * (a - 1.0 - 1e4 * x * x)]

    rows = rows_of(sharp, [0.5**0.5 / 100.0], (1.5, 0.7))
    (fold,) = [row for row in rows if row.label == "LP"]
    assert fold.orbit.value == pytest.approx(1.0, abs=1e-8)
    assert len(asked) < 2250


def test_newtons_method_that_comes_close_late_goes_on_to_the_orbit() -> None:
    def steep(state: Floats, a: float) -> list[float]:
        (x,) = state.tolist()
        return [x + np.exp(x) - np.exp(a)]

    # the method comes nearer by 1 each round, then by squares: in eight to 3e-12 and to 4e-7
    for start in (3.8, 4.6):
        first, *_ = rows_of(steep, [start], (0.0, 0.1))
        assert first.orbit.section.state[0] == pytest.approx(first.orbit.value, abs=1e-11)


def test_no_run_is_asked_for_beyond_the_end_of_the_range_but_for_differences() -> None:
    asked = []

    def counted(state: Floats, a: float) -> list[float]:
        asked.append(a)
        return henon(state, a)

    rows = rows_of(counted, [0.3, 0.3], (0.2, 0.3), step=0.5)
    assert told(rows[-1]) == ("EP", "end of the range")
    assert max(asked) < 0.3 + 1e-4 * 0.1


def test_where_many_impacts_begin_steps_are_shorter() -> None:
    def impacts(_state: Floats, a: float) -> int:
        return int(1e4 * a)

    rows = rows_of(pitchfork, [0.0], (0.1, 0.11), impacts=impacts, step=0.5)
    labels = "".join({"": ".", "GR": "g"}.get(row.label, "e") for row in rows)
    assert labels.count("g") == 100
    assert max(map(len, labels.split("."))) <= 8
    assert labels.endswith("e")


@pytest.mark.parametrize("before", [-1.2, 1.2])
def test_multipliers_that_jump_at_grazing_pass_nothing(before: float) -> None:
    def slope(a: float) -> float:
        return before if a < 0.3 else 0.2

    rows = rows_of(
        lambda x, a: [slope(a) * (x[0] - a) + a], [0.1], (0.1, 0.9), impacts=lambda _x, a: a < 0.3
    )
    assert [row.label for row in rows if row.label] == ["GR", "EP"]
    assert [len(row.orbit.multipliers) for row in rows] == [1] * len(rows)
    assert rows[-1].orbit.multipliers[0].real == pytest.approx(0.2)


def test_a_doubling_beside_grazing_is_told_apart_from_its_jump() -> None:
    def slope(a: float) -> float:
        return -0.8 - a if a < 0.21 else 0.2

    rows = rows_of(
        lambda x, a: [slope(a) * (x[0] - a) + a], [0.1], (0.1, 0.9), impacts=lambda _x, a: a < 0.21
    )
    (doubling,) = (row for row in rows if row.label == "PD")
    assert abs(doubling.orbit.values[0] - 0.2) <= doubling.bound <= 1e-6
    assert [row.label for row in rows if row.label] == ["PD", "GR", "EP"]


def test_impacts_that_begin_at_once_are_told_as_several() -> None:
    rows = rows_of(pitchfork, [0.0], (0.1, 0.9), impacts=lambda _state, a: 2 * int(a > 0.31))
    (touch,) = (row for row in rows if row.label == "GR")
    assert touch.note == "impacts begin: 0 before, 2 behind"
