"""Values that candidates give: extremes over windows and on grids, as whole runs have them."""

from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from jointplay.solver.calibration.measure import Measurement
from jointplay.solver.kinds import admit_calibration
from jointplay.solver.scene import presets
from tests.solver.calibration.calibrations import bounce
from tests.solver.completed_runs import run

CRANK = {"preset": "slider-crank", "parameters": {"clearance": 2e-4}}
PARAMETERS = {
    "stiffness": {"minimum": 1e8, "maximum": 1e10, "spacing": "log"},
    "restitution": {"minimum": 0.5, "maximum": 1.0},
}
CANDIDATES = np.array([[1e9, 0.5], [1e9, 1.0], [5e8, 0.7], [1e10, 0.9]])
GRID = 1e-5
STATISTICS = ("maximum", "minimum", "maximum_time", "minimum_time", "range")


def measured(targets: list[dict[str, Any]], **changes: Any) -> np.ndarray:
    targets = [{"value": 1.0, **target} for target in targets]
    document = bounce(scene=CRANK, parameters=PARAMETERS, cases=[{"targets": targets}], **changes)
    return Measurement(admit_calibration(document), every=True)(CANDIDATES)


def whole_run(candidate: np.ndarray, duration: float) -> Any:
    parameters = dict(zip(PARAMETERS, candidate.tolist(), strict=True))
    return run(
        "slider-crank",
        duration,
        parameters={**CRANK["parameters"], **parameters},
        output_step=GRID,
        tolerance=1e-6,
    )


def test_the_window_of_a_whole_run_gives_the_peaks_of_that_run():
    targets = [
        {"channel": channel, "statistic": statistic, "to": 0.002}
        for channel in ("P.normal_force", "acceleration")
        for statistic in STATISTICS
    ]
    values = measured(targets)
    for row, candidate in zip(values, CANDIDATES, strict=True):
        peaks = whole_run(candidate, 0.002).peaks
        expected = [
            value
            for peak in (peaks["P.normal_force"], peaks["acceleration"])
            for value in (
                peak.maximum,
                peak.minimum,
                peak.maximum_time,
                peak.minimum_time,
                peak.maximum - peak.minimum,
            )
        ]
        # the same steps but for the last one, which is cut in two
        np.testing.assert_allclose(row, expected, rtol=1e-9)


def test_what_is_read_off_a_grid_is_the_extreme_of_the_samples():
    window = {"from": 3e-4, "to": 0.0017, "sampled": GRID, "channel": "P.normal_force"}
    values = measured([{**window, "statistic": statistic} for statistic in STATISTICS])
    for row, candidate in zip(values, CANDIDATES, strict=True):
        found = whole_run(candidate, 0.002)
        inside = slice(30, 171)
        force, time = found["P.normal_force"][inside], found.time[inside]
        assert force.max() > 0.0
        np.testing.assert_allclose(
            row,
            [
                force.max(),
                force.min(),
                time[force.argmax()],
                time[force.argmin()],
                force.max() - force.min(),
            ],
            rtol=1e-12,  # rounding of k * step
        )


def test_windows_may_overlap_and_a_grid_may_lie_beside_them():
    """The disc bounces three times: a window around each finds that contact's force."""
    parameters = {"friction": 0.0, "restitution": 0.8, "stiffness": 1e9}
    found = run("bouncing-journal", 0.08, parameters=parameters, output_step=1e-5, tolerance=1e-6)
    contacts = found.contacts("bearing")[:3]
    between = (contacts["release"][:-1] + contacts["onset"][1:]) / 2.0
    edges = [0.0, *between.tolist(), 0.08]
    windows = [*pairwise(edges), (0.0, 0.08), (edges[1], 0.08)]
    force = {"channel": "bearing.normal_force", "value": 1.0}
    targets = [{**force, "from": start, "to": stop} for start, stop in windows]
    targets.append({**force, "from": edges[1], "to": edges[2], "sampled": 1e-5})
    document = bounce(
        scene={"preset": "bouncing-journal", "parameters": parameters},
        parameters={"stiffness": {"minimum": 1e8, "maximum": 1e10}},
        cases=[{"targets": targets}],
    )
    values = Measurement(admit_calibration(document), every=True)(np.array([[1e9]]))[0]
    peaks = contacts["peak_force"]
    # a run with windows ends a step at each edge: the error of a step, 1e-6, through three impacts
    np.testing.assert_allclose(values[:3], peaks, rtol=1e-3)
    np.testing.assert_array_equal(values[3:5], [values[0], values[1]])
    inside = (found.time >= edges[1]) & (found.time <= edges[2])
    assert values[5] == pytest.approx(found["bearing.normal_force"][inside].max(), rel=1e-3)
    assert values[5] < values[1]


def test_candidates_of_different_structure_are_measured_side_by_side():
    """The exponent 1.5 has a kernel of its own."""
    scene = {"preset": "bouncing-journal", "parameters": {"friction": 0.0, "stiffness": 1e9}}
    target = {"channel": "bearing.normal_force", "to": 0.02, "value": 1.0}
    document = bounce(
        scene=scene,
        parameters={"exponent": {"minimum": 1.2, "maximum": 1.5}},
        cases=[{"targets": [target]}],
    )
    exponents = np.array([1.5, 1.2, 1.5, 1.3])
    values = Measurement(admit_calibration(document), every=True)(exponents[:, None])[:, 0]
    for exponent, value in zip(exponents.tolist(), values, strict=True):
        parameters = {**scene["parameters"], "exponent": exponent}
        alone = run("bouncing-journal", 0.02, parameters=parameters, tolerance=1e-6)
        assert value == alone.peaks["bearing.normal_force"].maximum


def test_a_candidate_gives_the_same_whatever_is_computed_beside_it():
    targets = [{"channel": "acceleration", "statistic": s, "to": 0.002} for s in STATISTICS]
    document = bounce(
        scene=CRANK,
        parameters=PARAMETERS,
        cases=[{"targets": [{**t, "value": 1.0} for t in targets]}],
    )
    measure = Measurement(admit_calibration(document), every=True)
    together = measure(np.concatenate([CANDIDATES] * 3))
    for k, candidate in enumerate(CANDIDATES):
        np.testing.assert_array_equal(together[k::4], [measure(candidate[None, :])[0]] * 3)


def test_a_case_sets_parameters_whether_the_scene_is_a_preset_or_given_whole():
    """And a speed changes the start, which may not be shared then."""
    targets = [{"channel": "acceleration", "to": 0.002, "value": 1.0}]
    values = []
    for scene in (CRANK, presets.document("slider-crank")):
        document = bounce(
            scene=scene,
            parameters={"speed": {"minimum": 100.0, "maximum": 600.0}},
            cases=[{"parameters": {"clearance": 2e-4, "stiffness": 1e9}, "targets": targets}],
        )
        measure = Measurement(admit_calibration(document), every=True)
        values.append(measure(np.array([[300.0], [500.0]])))
    np.testing.assert_array_equal(values[0], values[1])
    for value, speed in zip(values[0], (300.0, 500.0), strict=True):
        alone = run(
            "slider-crank",
            0.002,
            parameters={"clearance": 2e-4, "stiffness": 1e9, "speed": speed},
            output_step=GRID,
            tolerance=1e-6,
        )
        assert value == alone.peaks["acceleration"].maximum


def test_a_run_that_takes_too_long_gives_no_number_and_leaves_the_others_standing():
    """At rest on a wall as hard as that, every step is a fraction of a microsecond."""
    document = bounce(
        scene={"preset": "bouncing-journal", "parameters": {"friction": 0.0, "restitution": 0.5}},
        parameters={"stiffness": {"minimum": 1e6, "maximum": 1e18, "spacing": "log"}},
        cases=[{"targets": [{"channel": "bearing.normal_force", "to": 0.5, "value": 1.0}]}],
        search={"most_steps": 5000},
    )
    measure = Measurement(admit_calibration(document), every=True)
    values = measure(np.array([[1e7], [1e15], [1e9]]))[:, 0]
    assert np.isnan(values).tolist() == [False, True, False]
    assert values[2] == measure(np.array([[1e9]]))[0, 0]
