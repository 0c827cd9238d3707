"""The loop's work beside attempting steps is bounded, in numbers of calls: a loss is noticed.

A run looks after single lanes only where contacts begin or end, samples or
sections are due, or a step is rejected. Bounds are a quarter above what was counted, and 0.01; the
slider-crank's motion is chaotic, and counts are the largest of six starts.
"""

import pytest

from jointplay.solver.kernels.target import own_target
from tests.solver.kernels.counted_work import CASES, WAYS, count

LANES = own_target().lanes

QUIET = 0.02
"""Share of attempts that a run in steady contact may be looked after: a period ends once in
ten thousand attempts, the pace is checked as rarely."""

ATTENDED = {
    "press, steady": 0.0001,
    "press, in flight": 0.1834,  # onsets, rejections
    "slider-crank, impacting": 0.1157,
    "driven pendulum": 0.01,  # the end of a period
    "journal, bouncing": 0.2121,
}
"""Share of the lanes' attempts after which a lane was looked after; what is sought beside the
motion changes nothing of it."""

CALLS = {
    "press, steady": {
        "extremes": {
            "scan_some": 0.002,
            "foresee_bends": 0.113,  # a lane is looked into in one step of eighty
            "penetrations_within": 0.004,
            "channels_within": 0.103,
            "channels_around": 0.004,
        },
        "crossings": {"scan_some": 0.009, "channels_within": 0.01},
    },
    "press, in flight": {
        "bare": {"penetrations_within": 1.395, "weigh": 0.136},
        "extremes": {
            "penetrations_within": 1.808,
            "scan_some": 0.643,
            "foresee_bends": 0.675,
            "channels_within": 0.685,
            "channels_around": 3.344,  # rounding of forces that nothing carries is not followed
        },
        "crossings": {"scan_some": 0.646, "channels_within": 0.24},
    },
    "slider-crank, impacting": {
        "bare": {"penetrations_within": 0.552, "weigh": 0.078},
        "extremes": {
            "scan_some": 0.6,
            "foresee_bends": 0.22,
            "channels_within": 0.244,
            "channels_around": 0.342,
        },
        "crossings": {"scan_some": 0.628, "channels_within": 0.291},
    },
    "driven pendulum": {
        "extremes": {
            "scan_some": 0.01,
            "foresee_bends": 0.004,
            "channels_within": 0.032,
            "channels_around": 0.107,
        },
        "crossings": {"scan_some": 0.55, "channels_within": 1.372},
    },
    "journal, bouncing": {
        "bare": {"penetrations_within": 0.872, "weigh": 0.116},
        "extremes": {
            "penetrations_within": 0.989,
            "scan_some": 0.858,
            "foresee_bends": 0.791,
            "channels_within": 1.174,  # each of its contacts is short, and resolved
            "channels_around": 1.524,
        },
        "crossings": {"scan_some": 0.954, "channels_within": 1.876},
    },
}
"""Calls while each of eight lanes makes an attempt: of a bare run, and what a way has beside or
more of. Functions that are not named are not called, but for those of every attempt."""
EVERY = {
    "bare": ("attempt", "take"),
    "extremes": ("attempt", "take", "observe", "foresee_looks", "remember", "scan"),
    "tangents": ("attempt", "take", "tangent_step"),
    "crossings": ("attempt", "take", "observe", "scan"),
}
"""Functions that are called at most once an attempt of a group of lanes."""


def bound(counted: float) -> float:
    return 1.25 * counted + 0.01


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("case", CASES)
def test_work_beside_the_attempts_is_bounded(case: str, way: str) -> None:
    work = count(CASES[case], way)
    assert work.attended <= bound(ATTENDED[case])
    if case == "press, steady":
        assert work.attended <= QUIET
    assert work.accepted >= 0.65 * work.attempts  # most of what is attempted is taken
    bare = CALLS[case].get("bare", {})
    groups = 8 / LANES
    once = dict.fromkeys(EVERY[way], groups)
    expected = {name: bound(calls) for name, calls in (bare | CALLS[case].get(way, {})).items()}
    for name in ("scan_some", "foresee_bends"):
        expected[name] = groups * expected.get(name, 0.0)  # one lane sends its group
    if way == "extremes":
        expected["remember_some"] = expected["scan_some"]  # where not all lanes take the step
    expected |= {"tangent_penetrations": bound(bare.get("weigh", 0.0))} if way == "tangents" else {}
    for function, calls in work.calls.items():
        assert calls <= (expected | once).get(function, 0.0) + 1e-12, function
