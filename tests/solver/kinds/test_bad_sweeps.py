"""Sweeps that are refused before anything is queued: at which field, and what would be right."""

from typing import Any

import pytest

from tests.solver.cams import CIRCLE, follower, valve
from tests.solver.kinds.refusals import assert_refused
from tests.solver.runs.study.jobs_of_studies import SWEEP
from tests.solver.sliders import block, thrown

PENDULUM = {"preset": "pendulum"}
S = SWEEP
LISTED = {**SWEEP, "grid": None}
WITHOUT_UNIT = {key: value for key, value in SWEEP.items() if key != "periods"}

BAD: dict[str, tuple[dict[str, Any], dict[str, Any], str, str]] = {
    "clearance zero in a sweep": (
        S,
        {"grid": {"clearance": [0.0, 1e-4]}},
        "/grid/clearance/0",
        "no motion to integrate",
    ),
    "grid and points": (S, {"points": [{"clearance": 1e-4}]}, "/grid", "not both"),
    "neither grid nor points": (LISTED, {}, "/grid", "one of 'grid' and 'points'"),
    "duration and periods": (S, {"duration": 1.0}, "/duration", "not both"),
    "neither duration nor periods": (WITHOUT_UNIT, {}, "/duration", "'periods'"),
    "unknown statistic": (S, {"statistics": ["avarage"]}, "/statistics/0", "'median'"),
    "statistics by a word": (S, {"statistics": "mean"}, "/statistics", "must be a list"),
    "statistic listed twice": (
        S,
        {"statistics": ["mean", "median", "mean"]},
        "/statistics/2",
        "'mean' is listed twice",
    ),
    "contacts without clearance": (
        {"kind": "sweep", "scene": PENDULUM, "points": [{"angle": 1.0}], "duration": 1.0},
        {"statistics": ["mean", "contact_share"]},
        "/statistics/1",
        "this scene has none",
    ),
    "few samples a period": (
        S,
        {"samples_per_period": 8},
        "/samples_per_period",
        "at least 16",
    ),
    "samples of nothing": (
        S,
        {"samples_per_period": 64, "statistics": ["impacts"]},
        "/samples_per_period",
        "no effect without 'statistics' of channels",
    ),
    "less than two samples": (
        S,
        {"statistics": ["mean"], "settle": 1.9999},
        "/samples_per_period",
        "less than two samples",
    ),
    "settling for all of it": (S, {"settle": 2.0}, "/settle", "must be shorter"),
    "periods without a period": (
        S,
        {"scene": PENDULUM, "grid": {"angle": [0.1, 0.2]}},
        "/periods",
        "No driver turns, so there is no period. Give a 'duration'.",
    ),
    "unknown parameter of a grid": (S, {"grid": {"frict": [0.1]}}, "/grid/frict", "'friction'"),
    "value of a grid outside": (
        S,
        {"grid": {"clearance": [1e-4], "friction": [0.1, 20.0]}},
        "/grid/friction/1",
        "between 0 and 10",
    ),
    "grid of nothing": (S, {"grid": {}}, "/grid", "at least 1"),
    "empty axis of a grid": (S, {"grid": {"friction": []}}, "/grid/friction", "at least 1"),
    "points without a parameter": (LISTED, {"points": [{}]}, "/points/0", "at least 1"),
    "points of different parameters": (
        LISTED,
        {"points": [{"friction": 0.1}, {"clearance": 1e-4}]},
        "/points/1",
        "lacks 'friction' and has 'clearance' besides",
    ),
    "unknown parameter of points": (
        LISTED,
        {"points": [{"frict": 0.1}]},
        "/points/0/frict",
        "'friction'",
    ),
    "value of a point outside": (
        LISTED,
        {"points": [{"friction": 0.1, "clearance": 1e-4}, {"friction": 11.0, "clearance": 1e-4}]},
        "/points/1/friction",
        "Value 1 of 'friction' is 11",
    ),
    "values of a point that do not fit": (
        LISTED,
        {
            "points": [
                {"bearing_radius": 5e-3, "clearance": 1e-4},
                {"bearing_radius": 1e-4, "clearance": 2e-4},
            ]
        },
        "/points/1/clearance",
        "Point 1 (bearing_radius = 0.0001 m, clearance = 0.0002 m): ",
    ),
    "unknown channel of a sweep": (S, {"channels": ["displacment"]}, "/channels/0", "displacement"),
}


def test_the_largest_lash_of_a_sweep_leaves_something_of_its_cam() -> None:
    scene = valve(follower("flat", CIRCLE))
    target = {"path": "/joints/cam/clearance/lash"}
    scene["parameters"] = {"lash": {"help": "Lash.", "unit": "m", "targets": [target]}}
    job = {"kind": "sweep", "scene": scene, "grid": {"lash": [1e-4, 0.5, 2e-4]}, "periods": 1}
    assert_refused(job, "/grid/lash/1", "leaves nothing of a cam")


def test_the_largest_lash_of_each_cam_of_a_sweep_leaves_something_of_it() -> None:
    scene = valve(follower("flat", {"type": "constant", "value": 0.005}))
    paths = {"base": "/joints/cam/profile/value", "lash": "/joints/cam/clearance/lash"}
    scene["parameters"] = {
        name: {"help": "Length.", "unit": "m", "targets": [{"path": path}]}
        for name, path in paths.items()
    }
    grid = {"base": [0.005, 0.0015], "lash": [0.001, 0.002]}  # 2 mm leave nothing of 1.5 mm alone
    job = {"kind": "sweep", "scene": scene, "grid": grid, "periods": 1}
    words = "Point 3 (base = 0.0015 m, lash = 0.002 m): A lash of 0.002 m leaves nothing of a cam"
    assert_refused(job, "/grid/lash/1", words)


def test_the_largest_offset_of_a_sweep_does_not_start_in_a_wall() -> None:
    scene = thrown(block(), 1.0, 0.0)
    scene["start"]["guides"] = {"guide": {"offset": 0.0}}
    target = {"path": "/start/guides/guide/offset"}
    scene["parameters"] = {"offset": {"help": "Offset.", "unit": "m", "targets": [target]}}
    job = {"kind": "sweep", "scene": scene, "grid": {"offset": [0.0, 0.05, 5e-4]}, "duration": 1.0}
    assert_refused(job, "/grid/offset/1", "would be in a wall")


@pytest.mark.parametrize(
    ("path", "values"),
    [("start/guides/cam/offset", [0.0, -0.5]), ("joints/cam/profile/offset", [0.04, 0.02])],
)
def test_a_flat_face_of_a_sweep_starts_before_the_centre_of_its_cam(path, values) -> None:
    scene = valve(follower("flat", CIRCLE, lash=1e-4))
    scene["start"]["guides"] = {"cam": {"offset": -0.015}}
    target = {"path": f"/{path}"}
    scene["parameters"] = {"at": {"help": "Offset.", "unit": "m", "targets": [target]}}
    job = {"kind": "sweep", "scene": scene, "grid": {"at": values}, "periods": 1}
    assert_refused(job, "/grid/at/1", "would be in a wall or a cam")


@pytest.mark.parametrize("case", BAD)
def test_a_bad_sweep_is_refused_at_its_field(case: str) -> None:
    job, changes, pointer, words = BAD[case]
    assert_refused({**job, **changes}, pointer, words)
