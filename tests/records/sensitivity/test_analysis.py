"""Indices, effects, quantiles and probabilities beside closed forms and beside scipy."""

from dataclasses import replace

import numpy as np
import pytest
from known_functions import (
    FOUR_BRANCHES,
    G_FUNCTION,
    ISHIGAMI,
    ISHIGAMI_VARIANCE,
    four_branches,
    g_function,
    ishigami,
    study_of,
)
from scipy import stats

from jointplay.records.channel import Channel
from jointplay.records.sensitivity import DESIGNS
from jointplay.records.sensitivity.analysis import (
    Analysis,
    NoSuchOutput,
    Question,
    sensitivity,
)
from jointplay.records.sensitivity.outputs import output, outputs
from jointplay.records.sensitivity.quantiles import quantiles
from jointplay.records.sensitivity.resampled import MOST_RESAMPLES, resamples_of
from jointplay.solver.distributions import DISTRIBUTIONS

MAXIMUM = Question("rod.x.maximum")


def values_of(found, name):
    return np.array(found["measures"][name]["values"])


@pytest.mark.parametrize(
    ("function", "parameters", "known"), [(ishigami, 3, ISHIGAMI), (g_function, 8, G_FUNCTION)]
)
def test_indices_are_those_of_closed_forms(function, parameters, known):
    found = sensitivity(study_of(function, 2**16, parameters), MAXIMUM)
    for name, expected in known.items():
        assert values_of(found, name) == pytest.approx(expected, abs=2e-4)
        low, high = (np.array(found["measures"][name][end]) for end in ("low", "high"))
        assert (low <= expected).all()
        assert (expected <= high).all()


def test_mean_and_variance_of_ishigami():
    found = sensitivity(study_of(ishigami, 2**16, 3), MAXIMUM)
    assert found["mean"] == pytest.approx(3.5, abs=1e-4)
    assert found["standard_deviation"] ** 2 == pytest.approx(ISHIGAMI_VARIANCE, rel=2e-4)


def test_indices_are_scipys_to_the_last_digits():
    study = study_of(ishigami, 256, 3)
    table = output(study, "rod.x.maximum").reshape(256, 5)
    scipys = stats.sobol_indices(
        func={"f_A": table[:, :1].T, "f_B": table[:, 1:2].T, "f_AB": table[:, 2:].T[:, None]},
        n=256,
    )
    found = sensitivity(study, MAXIMUM)
    assert values_of(found, "first_order") == pytest.approx(scipys.first_order, abs=1e-14)
    assert values_of(found, "total") == pytest.approx(scipys.total_order, abs=1e-14)


def test_intervals_contain_the_truth_as_often_as_they_say():
    inside = []
    for seed in range(60):
        found = sensitivity(study_of(ishigami, 64, 3, seed=seed), MAXIMUM)
        for name, expected in ISHIGAMI.items():
            low, high = (np.array(found["measures"][name][end]) for end in ("low", "high"))
            inside += ((low <= expected) & (expected <= high)).tolist()
    assert 0.9 < np.mean(inside) <= 1.0


def test_intervals_are_narrower_where_less_confidence_is_asked_for():
    study = study_of(ishigami, 64, 3)
    wide, narrow = (
        sensitivity(study, Question(confidence=share))["measures"]["total"] for share in (0.95, 0.5)
    )
    width = [np.subtract(one["high"], one["low"]) for one in (wide, narrow)]
    assert width[0] / width[1] == pytest.approx(1.96 / 0.674, rel=0.3)


def test_elementary_effects_of_a_plane_are_its_slopes():
    found = sensitivity(study_of(lambda x: 3.0 * x[:, 0] - 2.0 * x[:, 1], 16, 3, "morris"), MAXIMUM)
    assert values_of(found, "mean_effect") == pytest.approx([3.0, -2.0, 0.0], abs=1e-12)
    assert values_of(found, "mean_magnitude") == pytest.approx([3.0, 2.0, 0.0], abs=1e-12)
    assert values_of(found, "spread") == pytest.approx([0.0, 0.0, 0.0], abs=1e-6)
    assert found["measures"]["spread"]["unit"] == "m"
    assert (found["quantiles"], found["mean"]) == (None, None)


def test_an_interaction_shows_as_spread_of_the_effects():
    found = sensitivity(study_of(lambda x: x[:, 0] * x[:, 1], 4000, 2, "morris"), MAXIMUM)
    # the other one is at 1/8, 3/8, 5/8 or 7/8
    assert values_of(found, "mean_effect") == pytest.approx([0.5, 0.5], abs=0.02)
    assert values_of(found, "spread") == pytest.approx(2 * [np.std([1, 3, 5, 7]) / 8], abs=0.01)


def test_the_variance_of_effects_is_right_in_the_mean_of_small_designs():
    found = []
    for seed in range(300):
        effects = study_of(lambda x: x[:, 0] * x[:, 1], 4, 2, "morris", seed=seed)
        found.append(values_of(sensitivity(effects, MAXIMUM), "spread") ** 2)
    assert np.mean(found) == pytest.approx(np.var([1, 3, 5, 7]) / 64, rel=0.1)


def test_the_variance_of_a_sum_is_right_in_the_mean_of_small_hypercubes():
    """Each parameter has all its variance in any of them, over n."""
    found = []
    for seed in range(100):
        drawn = study_of(lambda x: (x > 0.5).sum(axis=1), 4, 64, "latin-hypercube", seed=seed)
        found.append(sensitivity(drawn, MAXIMUM)["standard_deviation"] ** 2)
    assert np.mean(found) == pytest.approx(64 / 4, rel=0.1)


def test_correlations_of_ranks_are_scipys():
    study = study_of(lambda x: np.exp(4.0 * x[:, 0]) - x[:, 1], 200, 3, "latin-hypercube")
    found = sensitivity(study, MAXIMUM)
    expected = [
        stats.spearmanr(column, output(study, "rod.x.maximum"))[0] for column in study.values.T
    ]
    assert values_of(found, "rank_correlation") == pytest.approx(expected, abs=1e-12)


def test_equal_outputs_share_their_rank():
    study = study_of(lambda x: np.round(3.0 * x[:, 0]), 50, 2, "latin-hypercube")
    found = sensitivity(study, MAXIMUM)
    expected = stats.spearmanr(study.values[:, 0], output(study, "rod.x.maximum"))[0]
    assert values_of(found, "rank_correlation")[0] == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("design", ["saltelli", "latin-hypercube"])
def test_quantiles_are_those_of_the_distribution(design):
    normal = DISTRIBUTIONS["normal"](distribution="normal", mean=5.0, standard_deviation=2.0)
    study = study_of(lambda x: normal.quantiles(x[:, 0]), 1024, 2, design)
    found = sensitivity(study, MAXIMUM)["quantiles"]
    expected = stats.norm(5.0, 2.0).ppf(found["shares"])
    assert found["values"] == pytest.approx(expected, abs=0.05)
    assert (np.array(found["low"]) < expected).all()
    assert (expected < np.array(found["high"])).all()


@pytest.mark.parametrize("rows", [8, 20, 60])
def test_intervals_of_quantiles_contain_the_truth_as_often_as_they_say(rows):
    """The points are independent; where few lie beyond a quantile its interval has no end there."""
    inside, known = [], np.array([0.05, 0.25, 0.5, 0.75, 0.95])
    drawn = np.random.default_rng(3).random((400, rows))
    for sample in drawn:
        values, low, high = quantiles(np.exp(5.0 * sample), known, 0.95)
        expected = np.exp(5.0 * known)
        inside.append(~(low > expected) & ~(high < expected))
        assert (values == np.quantile(np.exp(5.0 * sample), known, method="inverted_cdf")).all()
    assert (np.mean(inside, axis=0) > 0.93).all()
    assert (np.isnan(low[0]), np.isnan(high[4])) == (True, True)
    assert np.isfinite([low[2], high[2]]).all()


@pytest.mark.parametrize(("count", "share", "confidence"), [(100, 0.3, 0.9), (5000, 0.05, 0.99)])
def test_ends_of_quantiles_are_those_of_the_binomial_distribution(count, share, confidence):
    _, low, high = quantiles(np.arange(1.0, count + 1.0), np.array([share]), confidence)
    below, above = stats.binom.ppf([0.5 - confidence / 2, 0.5 + confidence / 2], count, share)
    assert (low[0], high[0]) == (below, above + 1)


@pytest.mark.parametrize(("p", "probability"), FOUR_BRANCHES.items())
@pytest.mark.parametrize("design", ["saltelli", "latin-hypercube"])
def test_the_probability_of_four_branches_is_within_its_interval(p, probability, design):
    normal = DISTRIBUTIONS["normal"](distribution="normal", mean=0.0, standard_deviation=1.0)
    study = study_of(lambda x: four_branches(normal.quantiles(x), p), 2**14, 2, design)
    found = sensitivity(study, Question(limit=0.0, failing="below"))["failure"]
    assert found["low"] < probability < found["high"]
    assert found["probability"] == pytest.approx(probability, rel=0.15)
    safe = sensitivity(study, Question(limit=0.0))["failure"]["probability"]
    assert safe + found["probability"] == pytest.approx(1.0, abs=1e-12)


def test_wilsons_interval_is_his():
    study = study_of(lambda x: x[:, 0], 100, 1, "latin-hypercube")
    found = sensitivity(study, Question(limit=0.9))["failure"]
    his = stats.binomtest(10, 100).proportion_ci(0.95, "wilson")
    assert found["probability"] == pytest.approx(0.1)
    assert (found["low"], found["high"]) == pytest.approx((his.low, his.high), abs=1e-12)


def test_rows_with_a_failed_point_leave_whole_and_are_counted():
    whole = sensitivity(study_of(ishigami, 64, 3), MAXIMUM)
    found = sensitivity(study_of(ishigami, 64, 3, failed=(2, 4, 11), waiting=(318,)), MAXIMUM)
    assert whole["rows"]["used"] == 64
    expected = {"used": 61, "left_out": 2, "waiting": 1, "failed_points": 3, "points_each": 5}
    assert found["rows"] == expected
    assert (whole["complete"], found["complete"]) == (True, False)
    used = np.delete(np.arange(64), [0, 2, 63])
    shares = study_of(ishigami, 64, 3).values.reshape(64, 5, 3)[used]
    analysis = Analysis(DESIGNS["saltelli"], 3, MAXIMUM, shares, ishigami(shares))
    expected = analysis.spreads()[0]["first_order"].values.tolist()
    assert found["measures"]["first_order"]["values"] == expected


def test_what_does_not_vary_has_no_measures_and_says_so():
    found = sensitivity(study_of(ishigami, 16, 3), Question("rod.x.mean"))
    assert (found["measures"], found["mean"], found["standard_deviation"]) == ({}, 3.0, 0.0)
    assert "no parameter matters" in found["note"]
    assert set(found["quantiles"]["values"]) == {3.0}


def test_too_few_rows_say_nothing():
    found = sensitivity(study_of(ishigami, 4, 3, failed=(3,)), Question(limit=1.0))
    assert found["measures"] == {}
    assert found["mean"] is found["quantiles"] is None
    assert found["complete"]
    assert found["note"] == (
        "Only 3 of 4 rows are whole, in the others a point failed or lacks the output:"
        " of less than 4 nothing can be said."
    )


def test_rows_that_wait_may_say_something_later():
    waiting = tuple(range(10, 40))
    found = sensitivity(study_of(ishigami, 8, 3, failed=(3,), waiting=waiting), MAXIMUM)
    assert found["note"] == "Less than 4 rows are whole: nothing can be said yet."


def test_what_is_said_of_rows_without_failures_is_said_to_be_of_them():
    """Where the largest outputs are not there, each number is of another distribution."""
    shares = study_of(ishigami, 64, 3).values
    high = tuple(np.flatnonzero(ishigami(shares) > 10.0).tolist())
    whole = sensitivity(study_of(ishigami, 64, 3), Question(limit=10.0))
    found = sensitivity(study_of(ishigami, 64, 3, failed=high), Question(limit=10.0))
    assert whole["note"] == ""
    # 0.0380 by 4e6 random draws; the standard error of 64 is 0.024
    assert whole["failure"]["probability"] == pytest.approx(0.038, abs=0.024)
    assert found["failure"]["probability"] == 0.0
    lost = found["rows"]["left_out"]
    assert found["note"].startswith(f"In {lost} of 64 rows a point failed")
    constant = sensitivity(study_of(ishigami, 64, 3, failed=(1,)), Question("rod.x.mean"))
    assert constant["note"].endswith(
        "the same at all points that count: no parameter matters to it there."
    )


def test_a_design_that_is_no_sample_gives_no_probability():
    found = sensitivity(study_of(ishigami, 8, 3, "morris"), Question(limit=1.0))
    assert found["failure"] is None
    assert "no sample" in found["note"]


def test_outputs_are_extremes_and_statistics_and_others_are_refused():
    study = study_of(ishigami, 8, 3)
    found = sensitivity(study, Question())
    assert found["outputs"] == ["rod.x.maximum", "rod.x.minimum", "rod.x.range", "rod.x.mean"]
    assert (found["output"], found["unit"]) == ("rod.x.maximum", "m")
    maximum, minimum = (output(study, f"rod.x.{end}") for end in ("maximum", "minimum"))
    assert output(study, "rod.x.range").tolist() == (maximum - minimum).tolist()
    with pytest.raises(NoSuchOutput, match=r"did you mean 'rod\.x\.maximum'"):
        sensitivity(study, Question("rod.x.maximun"))


def test_declared_outputs_come_first_then_contact_forces():
    study = study_of(ishigami, 8, 3)
    names = ("B.penetration", "B.normal_force", "rod.x")
    channels = [Channel(name, "m", name) for name in names]
    scene = {"outputs": [{"name": "rod.x"}]}
    several = replace(study, channels=channels, attributes={**study.attributes, "scene": scene})
    owners = [name.rpartition(".")[0] for name in outputs(several)]
    assert list(dict.fromkeys(owners)) == ["rod.x", "B.normal_force", "B.penetration"]


def test_work_is_bounded_and_the_same_answer_comes_again():
    assert resamples_of(64) == MOST_RESAMPLES
    for rows in (10_000, 100_000, 10**7):
        assert 200 <= resamples_of(rows) < MOST_RESAMPLES
    study = study_of(ishigami, 64, 3)
    assert sensitivity(study, MAXIMUM) == sensitivity(study, MAXIMUM)


def test_what_varies_by_errors_of_the_runs_is_said_to():
    """Random errors of 1e-9 have no cause among the parameters, yet total indices of 1."""
    noise = np.random.default_rng(1)

    def told(error, level=1.0, **fields):
        study = study_of(lambda x: level + error * noise.standard_normal(len(x)), 256, 2, **fields)
        return sensitivity(study, MAXIMUM)

    found = told(1e-9, tolerance=1e-8)
    assert values_of(found, "total") == pytest.approx([1.0, 1.0], abs=0.3)
    assert "errors of the runs" in found["note"]
    assert told(1e-9, tolerance=1e-12)["note"] == ""
    assert told(1e-3, tolerance=1e-6)["note"] == ""
    assert sensitivity(study_of(ishigami, 64, 3, tolerance=1e-3), MAXIMUM)["note"] == ""


def test_a_statistic_is_as_large_as_its_channel():
    """The mean of a speed over whole periods is zero, and what is left of it is rounding."""
    study = study_of(lambda x: 1.0 + x[:, 0], 64, 2)
    study.statistics["rod.x.mean"] = 1e-16 * np.random.default_rng(0).normal(size=study.points)
    found = sensitivity(study, Question("rod.x.mean"))
    assert values_of(found, "total").max() > 0.3
    assert "errors of the runs may make 2e-08 of that" in found["note"]
    study.statistics["rod.x.mean"] = 1e-3 * study.values[:, 0]
    assert sensitivity(study, Question("rod.x.mean"))["note"] == ""


def test_where_a_run_came_to_before_it_failed_is_no_size_of_the_output():
    study = study_of(ishigami, 64, 3, failed=(2,), tolerance=1e-3)
    plain = sensitivity(study, MAXIMUM)["note"]
    study.peaks("rod.x").maximum[2] = 1e9
    assert "errors of the runs" not in plain
    assert sensitivity(study, MAXIMUM)["note"] == plain
