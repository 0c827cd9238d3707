"""A sound study after its admission: every default, times, points, and one digest."""

import math

import pytest

from jointplay.solver.kinds import parse
from jointplay.solver.scene import presets
from tests.solver.runs.study.jobs_of_studies import (
    ACCURACY_STUDY,
    BIFURCATION,
    ENSEMBLE,
    POINCARE,
    PRESS,
    STUDIES,
    SWEEP,
    study,
)


def test_sections_by_event_need_no_common_period() -> None:
    parameters = {"speed": 1.0, "speed_crank4": math.sqrt(2.0)}
    scene = {"preset": "seven-bar-press", "parameters": parameters}
    found = study(POINCARE, scene=scene, section={"onset": "A"}, settle=3, record=2)
    fastest = 2.0 * math.pi / math.sqrt(2.0)
    assert found.period.tolist() == pytest.approx([fastest])
    # settling and at most twenty periods a section
    assert found.duration.tolist() == pytest.approx([43 * fastest])


def test_a_branch_without_a_section_does_not_end_with_events() -> None:
    scene = {"preset": "impact-oscillator"}
    speeds = {"from": 25.0, "to": 33.0, "count": 5}
    branch = {"kind": "continuation", "scene": scene, "parameter": "speed", "values": speeds}
    found = study(branch)
    assert found.job["section"] is None
    assert not found.ends_with_events
    assert study(POINCARE, section={"onset": "A"}).ends_with_events


def test_what_the_job_leaves_out_is_filled_in() -> None:
    filled = study(BIFURCATION).job
    assert filled["settle"] == 100
    assert filled["record"] == 50
    assert filled["section"] == {"crank_angle": 0.0}
    assert filled["indicators"] == []
    assert (filled["continuation"], filled["chains"]) == ("none", 8)
    assert filled["tolerance"] == 1e-6
    assert filled["formulation"] == "reduced"
    assert filled["scene"]["parameters"]["friction"] == 0.01
    spread = study(ENSEMBLE).job
    assert (spread["spread"], spread["seed"]) == (1e-3, 0)
    assert parse(spread | {"spread": 0.0}).perturbation.spread == 0.0  # admitted once


def test_indicators_are_listed_once_and_in_order() -> None:
    assert study(POINCARE, indicators=["zero_one", "lyapunov", "zero_one"]).indicators == (
        "lyapunov",
        "zero_one",
    )
    everything = ("lyapunov", "zero_one", "recurrence", "rotation", "spectrum")
    assert study(POINCARE, indicators="all").indicators == everything
    assert study(POINCARE, indicators=["all"]).indicators == everything


def test_indicators_that_compare_sections_take_a_smaller_tolerance_unless_one_is_given() -> None:
    for name in ("lyapunov", "zero_one", "recurrence", "rotation"):
        assert study(POINCARE, indicators=[name]).job["tolerance"] == 1e-9
    assert study(BIFURCATION, indicators="all").job["tolerance"] == 1e-9
    assert study(POINCARE, indicators=["spectrum"]).job["tolerance"] == 1e-6
    assert study(POINCARE, indicators="all", tolerance=1e-7).job["tolerance"] == 1e-7
    assert study(POINCARE, indicators="all", accuracy="standard").job["tolerance"] == 1e-6
    assert study(POINCARE, indicators="all", accuracy="fine").job["tolerance"] == 1e-8


def test_times_of_a_study_follow_its_periods_and_section() -> None:
    found = study(POINCARE, settle=10, record=5, section={"crank_angle": math.pi / 2})
    assert found.period.tolist() == pytest.approx([2.0])
    assert found.offset.tolist() == pytest.approx([0.5])
    assert found.settle.tolist() == pytest.approx([20.0])
    assert found.duration.tolist() == pytest.approx([30.5])
    swept = study(SWEEP, settle=0.5)
    assert swept.duration.tolist() == pytest.approx([4.0] * 6)
    assert swept.settle.tolist() == pytest.approx([1.0] * 6)


def test_a_motion_counts_as_an_even_turn_in_each_of_its_periods() -> None:
    scene = presets.document("slider-crank")
    (name,) = scene["drivers"]
    motion = {"type": "sinusoidal", "amplitude": 0.2, "frequency": 8.0}  # never turned by 1 rad
    scene["drivers"][name] = {"body": "crank", "motion": motion}
    scene.pop("parameters")
    job = {"kind": "poincare", "scene": scene, "section": {"crank_angle": 1.0}}
    assert study(job).offset.tolist() == pytest.approx([1.0 / 8.0])
    assert study(job).period.tolist() == pytest.approx([math.pi / 4.0])


def test_a_grid_varies_its_last_parameter_fastest() -> None:
    found = study(SWEEP)
    assert found.parameters == ("clearance", "friction")
    assert found.parameter_units == ("m", "1")
    assert found.values.tolist() == [
        [c, f] for c in (1e-4, 3e-4) for f in (0.0, 0.05, 0.1)
    ]  # halves of a tenth are exact enough to compare


def test_a_logarithmic_range_has_equal_ratios_and_exact_ends() -> None:
    found = study(
        BIFURCATION, values={"from": 1e-4, "to": 1e-3, "count": 5, "spacing": "log"}
    ).values[:, 0]
    assert found[0] == 1e-4
    assert found[-1] == 1e-3
    # a handful of roundings
    assert found[1:] / found[:-1] == pytest.approx([10 ** (1 / 4)] * 4, rel=1e-14)


@pytest.mark.parametrize("kind", STUDIES)
def test_the_digest_ignores_the_label_and_spelled_out_defaults_but_nothing_else(kind: str) -> None:
    job = STUDIES[kind]
    first = study(job)
    assert study(job, label="a name").digest == first.digest
    if kind == "accuracy-study":  # it has no one tolerance
        assert study(job, duration=2.0, tolerances=first.job["tolerances"]).digest == first.digest
        assert study(job, tolerances=[1e-7]).digest != first.digest
    else:
        assert study(job, accuracy="standard").digest == first.digest
        assert study(job, tolerance=1e-7).digest != first.digest
    assert study(job, scene={**PRESS, "parameters": {"stiffness": 4e9}}).digest != first.digest


def test_methods_and_tolerances_are_listed_once_and_in_order() -> None:
    twice = study(
        ACCURACY_STUDY, methods=["rk4", "tsitouras", "rk4"], tolerances=[1e-8, 1e-4, 1e-8]
    )
    assert twice.job["methods"] == ["tsitouras", "rk4"]
    assert twice.job["tolerances"] == [1e-4, 1e-8]
    assert (twice.job["duration"], twice.blocks) == (2.0, ((0, twice.points),))
    # two references, two tolerances, six steps, and the default
    assert twice.points == 11
    pendulum = study(ACCURACY_STUDY, scene={"preset": "pendulum"})
    assert pendulum.job["duration"] == 1.0


def test_the_digest_tells_values_apart() -> None:
    digests = {study(BIFURCATION, values=[1e-4, last]).digest for last in (3e-4, 4e-4)}
    assert len(digests) == 2
