"""Verdicts: from made-up evidence, and on systems whose motion is known."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from jointplay.solver.nonlinear.decision import decide
from jointplay.solver.nonlinear.estimate import UNKNOWN, Estimate
from jointplay.solver.nonlinear.grounds import grounds
from jointplay.solver.nonlinear.lyapunov import confirmed
from jointplay.solver.nonlinear.recurrence import recurrence_period
from jointplay.solver.nonlinear.rotation import rotation_number
from jointplay.solver.nonlinear.verdict import (
    CHAOTIC,
    PERIODIC,
    QUASI_PERIODIC,
    UNDECIDED,
    VERDICTS,
    Verdict,
)
from jointplay.solver.nonlinear.zero_one import zero_one_test
from tests.solver.nonlinear.exponents import map_exponent, tangent_exponent
from tests.solver.nonlinear.textbook import (
    HENON,
    UEDA,
    Map,
    delayed_logistic,
    duffing,
    impact_oscillator,
    logistic,
)

POSITIVE, ZERO, NEGATIVE = Estimate(0.5, 0.1), Estimate(0.01, 0.02), Estimate(-0.5, 0.1)
IRREGULAR, BETWEEN, REGULAR = Estimate(0.99, 0.02), Estimate(0.5, 0.3), Estimate(0.0, 0.05)
VAGUE = Estimate(0.7, 1.0)
TURNING, HESITANT = Estimate(0.3, 1e-6), Estimate(0.3, 0.1)


def test_codes_keep_their_meaning() -> None:
    """They are stored: a change would rewrite old results."""
    assert VERDICTS == {
        "undecided": 0,
        "periodic": 1,
        "quasi-periodic": 2,
        "chaotic": 3,
        "equilibrium": 4,
    }


@pytest.mark.parametrize(
    ("lyapunov", "zero_one", "period", "rotation", "code", "said"),
    [
        (POSITIVE, IRREGULAR, 0, None, CHAOTIC, "the 0-1 test agrees"),
        (POSITIVE, IRREGULAR, None, None, CHAOTIC, "the 0-1 test agrees"),
        (POSITIVE, None, 0, None, CHAOTIC, "no 0-1 test"),
        (POSITIVE, VAGUE, 0, None, CHAOTIC, "no 0-1 test"),
        (POSITIVE, BETWEEN, 0, None, UNDECIDED, "does not agree, K is 0.50 ± 0.30"),
        (POSITIVE, REGULAR, 0, TURNING, UNDECIDED, "does not agree"),
        (POSITIVE, IRREGULAR, 3, None, UNDECIDED, "recurs after 3, yet neighbours part"),
        (Estimate(0.5, 0.1, drifting=True), None, 0, None, UNDECIDED, "still drifts"),
        (Estimate(0.5, 0.1, drifting=True), IRREGULAR, 0, None, CHAOTIC, "agrees"),
        (NEGATIVE, REGULAR, 2, None, PERIODIC, "recurs after 2 and the exponent is -0.50"),
        (NEGATIVE, IRREGULAR, 2, None, PERIODIC, "recurs after 2"),
        (NEGATIVE, None, 1, None, PERIODIC, "recurs after 1"),
        (ZERO, REGULAR, 4, TURNING, PERIODIC, "close to a bifurcation"),
        (ZERO, IRREGULAR, 4, None, UNDECIDED, "yet the 0-1 test sees chaos"),
        (None, None, 5, None, PERIODIC, "not known"),
        (None, IRREGULAR, 5, None, UNDECIDED, "yet the 0-1 test sees chaos"),
        (NEGATIVE, REGULAR, 0, None, UNDECIDED, "neighbours converge"),
        (ZERO, REGULAR, 0, TURNING, QUASI_PERIODIC, "rotation number 0.3"),
        (ZERO, REGULAR, 0, None, UNDECIDED, "is not known: settle for longer"),
        (ZERO, REGULAR, None, None, UNDECIDED, "or add the indicator 'rotation' or 'recurrence'"),
        (ZERO, REGULAR, 0, UNKNOWN, UNDECIDED, "is no closed curve: settle for longer"),
        (ZERO, REGULAR, None, UNKNOWN, UNDECIDED, ", or add the indicator 'recurrence'"),
        (ZERO, REGULAR, 0, HESITANT, UNDECIDED, "rotation number is 0.30 ± 0.10"),
        (ZERO, BETWEEN, 0, TURNING, UNDECIDED, "sees no regular motion"),
        (ZERO, IRREGULAR, 0, TURNING, UNDECIDED, "sees no regular motion"),
        (ZERO, None, 0, TURNING, UNDECIDED, "no telling 0-1 test"),
        (ZERO, None, None, None, UNDECIDED, "'zero_one', or record four sections or more with"),
        (None, IRREGULAR, 0, None, UNDECIDED, "no short period is seen (K is 0.99"),
        (UNKNOWN, UNKNOWN, 0, None, UNDECIDED, "may not have settled, or have a longer"),
        (None, None, None, None, UNDECIDED, "without an exponent"),
    ],
)
def test_evidence_is_weighed(
    lyapunov: Estimate | None,
    zero_one: Estimate | None,
    period: int | None,
    rotation: Estimate | None,
    code: int,
    said: str,
) -> None:
    verdict = decide(lyapunov, zero_one, period, rotation)
    assert verdict.code == code
    assert said in verdict.reason
    assert verdict.period == (period if code == PERIODIC else 0)


estimates = st.none() | st.builds(Estimate, st.floats(-2.0, 2.0), st.floats(0.0, 2.0))


@given(estimates, estimates, st.none() | st.integers(0, 32), estimates)
def test_no_verdict_goes_beyond_its_evidence(
    lyapunov: Estimate | None,
    zero_one: Estimate | None,
    period: int | None,
    rotation: Estimate | None,
) -> None:
    verdict = decide(lyapunov, zero_one, period, rotation)
    telling = zero_one is not None and zero_one.error < 0.5
    assert verdict.reason
    if verdict.code == CHAOTIC:
        assert lyapunov is not None
        assert lyapunov.value > 3.0 * lyapunov.error
        assert not telling or zero_one.value > 0.9
        assert not period
    if verdict.code == PERIODIC:
        assert period == verdict.period > 0
        assert lyapunov is None or lyapunov.value <= 3.0 * lyapunov.error
    if verdict.code == QUASI_PERIODIC:
        assert lyapunov is not None
        assert abs(lyapunov.value) <= 3.0 * lyapunov.error
        assert telling
        assert zero_one.value < 0.1
        assert rotation is not None
        assert not period


@given(estimates, estimates, st.none() | st.integers(0, 32), estimates, estimates)
def test_who_decides_nothing_says_what_to_try(
    lyapunov: Estimate | None,
    zero_one: Estimate | None,
    period: int | None,
    rotation: Estimate | None,
    finer: Estimate | None,
) -> None:
    verdict = decide(lyapunov, zero_one, period, rotation, finer)
    assert "contact" not in verdict.reason  # what moves may have none
    if verdict.code == UNDECIDED and lyapunov is not None:
        assert any(word in verdict.reason for word in ("smaller tolerance", "record", "settle for"))


def test_a_reason_names_the_error_of_the_record_and_the_error_in_all() -> None:
    exponent, finer = Estimate(-0.5, 0.01), Estimate(-0.53, 0.02)
    reason = decide(exponent, None, 1, None, finer).reason
    assert f"the exponent is {exponent} 1/s, in all {confirmed(exponent, finer)} 1/s" in reason
    assert "-0.500 ± 0.010 1/s, in all -0.500 ± 0.030 1/s" in reason
    assert "in all" not in decide(exponent, None, 1).reason


@pytest.mark.parametrize("period", [0, 1])
def test_an_exponent_that_smaller_steps_contradict_decides_nothing(period: int) -> None:
    verdict = decide(POSITIVE, IRREGULAR, period, None, NEGATIVE)
    assert verdict.code == UNDECIDED
    assert "in far smaller steps" in verdict.reason
    assert str(NEGATIVE) in verdict.reason


def test_chaos_needs_an_exponent_above_zero_in_smaller_steps_too() -> None:
    assert decide(POSITIVE, IRREGULAR, 0, None, Estimate(0.4, 0.1)).code == CHAOTIC
    vague = decide(POSITIVE, IRREGULAR, 0, None, Estimate(0.4, 0.2))
    assert vague.code == UNDECIDED
    assert "record more sections" in vague.reason


@pytest.mark.parametrize("exponent", [Estimate(-math.inf, 0.0), Estimate(0.5, math.inf)])
def test_an_infinite_exponent_decides_nothing(exponent: Estimate) -> None:
    assert decide(exponent, IRREGULAR, 0).code == UNDECIDED
    assert "not known" in decide(exponent, REGULAR, 2).reason


def test_verdicts_have_names() -> None:
    assert Verdict(PERIODIC, 3, "").name == "period-3"
    assert [Verdict(code, 0, "").name for code in (0, 2, 3)] == [
        "undecided",
        "quasi-periodic",
        "chaotic",
    ]


def verdict_on(system: Map, count: int = 1000) -> Verdict:
    orbit = system.orbit(count, 2000)
    scale = np.ptp(orbit, axis=0) + 1e-9
    return decide(
        map_exponent(system.step, system.jacobian, orbit[0], count),
        zero_one_test(orbit, resolution=1e-4 * scale),
        recurrence_period(orbit, scale, 1e-4),
        rotation_number(orbit) if orbit.shape[1] == 2 else None,
    )


@pytest.mark.parametrize(
    ("system", "name"),
    [
        (logistic(2.8), "period-1"),
        (logistic(3.2), "period-2"),
        (logistic(3.5), "period-4"),
        (logistic(3.55), "period-8"),
        (logistic(3.83), "period-3"),
        (logistic(3.7), "chaotic"),
        (logistic(3.9), "chaotic"),
        (HENON, "chaotic"),
        (delayed_logistic(1.9), "period-1"),
        (delayed_logistic(2.05), "quasi-periodic"),
        (delayed_logistic(2.1), "quasi-periodic"),
        (delayed_logistic(2.18), "period-7"),
        (delayed_logistic(2.27), "chaotic"),
    ],
)
def test_maps_are_what_they_are_known_to_be(system: Map, name: str) -> None:
    assert verdict_on(system).name == name


def test_weak_chaos_is_undecided_at_first_and_chaos_in_the_end() -> None:
    """Two bands at r = 3.6: the exponent is clear at once, the 0-1 test needs longer."""
    assert verdict_on(logistic(3.6), 500).code == UNDECIDED
    assert verdict_on(logistic(3.6), 5000).code == CHAOTIC


def test_the_feigenbaum_point_is_undecided() -> None:
    """At r = 3.5699 … the motion is neither periodic nor chaotic nor on a closed curve."""
    assert verdict_on(logistic(3.569945672)).code == UNDECIDED


@pytest.mark.parametrize(
    ("system", "name"),
    [
        (UEDA, "chaotic"),
        (duffing(1.0), "period-1"),
        (impact_oscillator(0.05, 0.8, 2.4, 0.0), "period-1"),
        (impact_oscillator(0.02, 0.8, 2.8, 0.0), "chaotic"),
    ],
    ids=["Ueda", "weakly driven", "one impact a period", "many impacts"],
)
def test_driven_oscillators_are_what_they_are_known_to_be(system, name: str) -> None:
    section = system.section(320, 150)
    exponent = tangent_exponent(system.flow, section[-1], system.block_time, 200, system.steps // 2)
    scale = np.ones(2)
    verdict = decide(
        exponent,
        zero_one_test(section, resolution=1e-4),
        recurrence_period(section, scale, 1e-4),
        rotation_number(section),
    )
    assert verdict.name == name, verdict.reason


def test_reasons_are_sentences_with_numbers() -> None:
    assert not math.isnan(POSITIVE.value)
    assert decide(POSITIVE, IRREGULAR, 0).reason == (
        "neighbours part, the exponent is 0.50 ± 0.10 1/s, and the 0-1 test agrees,"
        " K is 0.990 ± 0.020"
    )


@pytest.mark.parametrize(
    ("lyapunov", "zero_one", "period"),
    [
        (Estimate(-0.5, 0.01), None, 3),
        (Estimate(0.5, 0.01), Estimate(0.99, 0.01), 0),
        (Estimate(0.0, 0.01), None, 0),
        (None, None, 1),
    ],
)
def test_grounds_follow_from_the_numbers_that_are_kept(lyapunov, zero_one, period) -> None:
    verdict = decide(lyapunov, zero_one, period)
    kept = {"verdict": float(verdict.code), "period": float(period)}
    for name, one in (("lyapunov", lyapunov), ("zero_one", zero_one)):
        if one is not None:
            kept |= {name: one.value, f"{name}_error": one.error}
    assert grounds(kept) == verdict.reason


def test_where_kept_numbers_do_not_give_the_verdict_the_grounds_say_so() -> None:
    """The exponent in smaller steps, which is not kept, was another."""
    kept = {"verdict": 0.0, "period": 0.0, "lyapunov": 0.5, "lyapunov_error": 0.01}
    assert "smaller steps: it is 0.50" in grounds(kept)
    assert "nothing moves" in grounds({"verdict": 4.0})
    assert grounds({"verdict": math.nan}) == grounds({}) == ""
