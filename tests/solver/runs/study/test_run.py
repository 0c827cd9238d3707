"""Blocks of studies: the same bits as single runs, whatever shares the lanes or interrupts them."""

from collections import defaultdict
from dataclasses import astuple
from typing import Any

import numpy as np
import pytest

from jointplay.records.point import PointEnd
from jointplay.solver.kinds import Admission, Study, admit
from jointplay.solver.runs import budget
from jointplay.solver.runs.simulate import Simulation
from jointplay.solver.runs.study.run import StudyRun
from tests.solver.completed_runs import CASE_3

PERIOD = 2.0
SCENE = {"preset": "seven-bar-press", "parameters": CASE_3}
DIAGRAM = {
    "kind": "bifurcation",
    "scene": SCENE,
    "parameter": "clearance",
    "values": [5e-4, 2e-4, 8e-4, 4e-4, 3e-4, 6e-4, 7e-4, 9e-4, 2.5e-4, 3.5e-4],
    "settle": 1,
    "record": 3,
}


class Computed:
    """Everything that the blocks of a study handed out."""

    def __init__(self, document: dict[str, Any]) -> None:
        study = admit(document)
        assert isinstance(study, Study)
        self.study = study
        self.ends: dict[int, PointEnd] = {}
        self.rows: dict[int, list[np.ndarray]] = defaultdict(list)
        self.times: dict[int, list[np.ndarray]] = defaultdict(list)
        for block in range(len(study.blocks)):
            self.take(StudyRun(study, block))

    def take(self, run: StudyRun, most_slices: int = 10**9) -> bytes | None:
        """Take slices until the block ends, or a restart point after so many."""
        for number, piece in enumerate(run.slices(), start=1):
            for rows in piece.rows:
                assert rows.first == sum(map(len, self.times[rows.point]))
                self.rows[rows.point].append(rows.values)
                self.times[rows.point].append(rows.time)
            self.ends |= {end.point: end for end in piece.ended}
            if number == most_slices:
                return run.checkpoint()
        return None

    def sections(self, point: int) -> np.ndarray:
        """(sections, observables) of a point."""
        return np.concatenate(self.rows[point])

    def bytes(self) -> dict[int, tuple[bytes, bytes, str]]:
        """All that a reader of the results could compare."""
        return {
            point: (
                self.sections(point).tobytes(),
                np.concatenate(self.times[point]).tobytes(),
                repr((end.code, end.statistics, end.indicators, end.peaks.tolist())),
            )
            for point, end in self.ends.items()
        }


@pytest.fixture(scope="module")
def diagram() -> Computed:
    return Computed(DIAGRAM)


def run_alone(
    duration: float, more: dict[str, Any] | None = None, **values: float
) -> tuple[Admission, list[Any], Simulation]:
    scene = SCENE | {"parameters": CASE_3 | values}
    document = {"kind": "simulate", "scene": scene, "duration": duration, "output_step": duration}
    admission = admit(document | (more or {}))
    assert isinstance(admission, Admission)
    simulation = Simulation(admission)
    return admission, list(simulation.slices()), simulation


def sections_alone(study: Study, periods: int, **values: float) -> np.ndarray:
    """(sections, observables) of a run of its own."""
    admission, slices, _ = run_alone(periods * PERIOD, **values)
    names = [channel.name for channel in admission.channels]
    columns = [names.index(channel.name) for channel in study.observables]
    found: np.ndarray = np.concatenate([piece.sections for piece in slices])[:, columns]
    return found


def test_sections_have_the_bits_of_a_run_of_one_value_alone(diagram: Computed) -> None:
    alone = sections_alone(diagram.study, 4, clearance=4e-4)
    assert diagram.sections(3).tobytes() == alone[2:].tobytes()


def test_a_clearance_of_zero_beside_others_has_the_bits_of_its_run_alone() -> None:
    changes = {"parameter": "clearance_B", "values": [1e-4, 0.0], "settle": 0, "record": 2}
    found = Computed(DIAGRAM | changes)
    assert found.study.structure.tolist() == [0, 1]  # the loop by B is closed: no play, no contact
    for point, clearance in enumerate(changes["values"]):
        alone = sections_alone(found.study, 2, clearance_B=clearance)
        assert found.sections(point).tobytes() == alone[1:].tobytes()


def test_every_value_ends_with_its_sections_at_whole_periods(diagram: Computed) -> None:
    assert sorted(diagram.ends) == list(range(10))
    for point, end in diagram.ends.items():
        assert end.code == ""
        assert end.time == 4 * PERIOD
        assert np.concatenate(diagram.times[point]).tolist() == [2 * PERIOD, 3 * PERIOD, 4 * PERIOD]


def test_interrupted_anywhere_and_resumed_it_gives_the_same_bits(
    diagram: Computed, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(budget, "FIRST", 311)
    monkeypatch.setattr(budget, "LARGEST", 977)
    disturbed = Computed.__new__(Computed)
    disturbed.study = diagram.study
    disturbed.ends, disturbed.rows, disturbed.times = {}, defaultdict(list), defaultdict(list)
    for block in range(len(diagram.study.blocks)):
        checkpoint: bytes | None = None
        for most in (1, 3, 7, 10**9):
            checkpoint = disturbed.take(StudyRun(diagram.study, block, checkpoint), most)
    assert disturbed.bytes() == diagram.bytes()


def test_a_sweep_has_the_extremes_of_single_runs() -> None:
    grid = {"clearance": [3e-4, 5e-4], "friction": [0.0, 0.1]}
    constant = {name: x for name, x in SCENE["parameters"].items() if name not in grid}
    scene = SCENE | {"parameters": constant}
    swept = Computed({"kind": "sweep", "scene": scene, "grid": grid, "duration": 0.5})
    assert len(set(swept.study.structure.tolist())) == 2  # without friction another kernel
    _, _, simulation = run_alone(0.5, clearance=5e-4)
    peaks = simulation.summary().peaks
    point = 3
    assert swept.study.values[point].tolist() == [5e-4, 0.1]
    for channel, row in zip(swept.study.channels, swept.ends[point].peaks, strict=True):
        peak = peaks[channel.name]
        assert row.tolist() == [peak.minimum, peak.minimum_time, peak.maximum, peak.maximum_time]


@pytest.mark.parametrize("settle", [0.0, 0.2137])
def test_a_sweep_has_the_bits_of_single_runs_that_settle_as_long(settle: float) -> None:
    """Every channel, in a study that is interrupted, beside runs with samples of their own."""
    grid = {"clearance": [2e-4, 3e-4, 4e-4, 7e-4]}
    more = {"channels": ["*"], "settle": settle}
    document = {"kind": "sweep", "scene": SCENE, "grid": grid, "duration": 0.5, **more}
    study = admit(document)
    assert isinstance(study, Study)
    ends: dict[int, PointEnd] = {}
    checkpoint: bytes | None = None
    for most in (1, 10**9):
        block = StudyRun(study, 0, checkpoint)
        for number, piece in enumerate(block.slices(), start=1):
            ends |= {end.point: end for end in piece.ended}
            if number == most:
                checkpoint = block.checkpoint()
                break
    own = {"certificate": False, "output_step": 0.5 / 640, **more}
    for point, clearance in enumerate(grid["clearance"]):
        _, _, simulation = run_alone(0.5, own, clearance=clearance)
        summary = simulation.summary()
        rows = np.array([astuple(peak) for peak in summary.peaks.values()])
        assert [channel.name for channel in study.channels] == list(summary.peaks)
        assert ends[point].peaks.tobytes() == rows.tobytes()
        for name in ("steps", "rejections", "onsets", "smallest_step"):
            assert ends[point].statistics[name] == summary.statistics[name]


def test_what_comes_before_settling_is_no_extreme() -> None:
    document = {"kind": "sweep", "scene": SCENE, "grid": {"clearance": [5e-4]}, "duration": 1.0}
    late = Computed(document | {"settle": 0.25}).ends[0].peaks
    whole = Computed(document).ends[0].peaks
    assert np.all(late[:, [1, 3]] >= 0.25)
    assert np.all(
        late[:, 0] >= whole[:, 0] - 1e-6 * np.abs(whole[:, 0])
    )  # restart within tolerance
    force = [c.name for c in Computed(document).study.channels].index("A.normal_force")
    assert late[force, 2] < whole[force, 2]  # the first impacts are the hardest


def test_an_extreme_soon_after_settling_is_found() -> None:
    """A journal that bounces without loss comes back to its height, in one long step of flight."""
    parameters = {"restitution": 1.0, "friction": 0.0, "stiffness": 5e9}
    document = {
        "kind": "sweep",
        "scene": {"preset": "bouncing-journal"},
        "points": [parameters],
        "channels": ["journal.y"],
        "duration": 0.03,
        "settle": 0.016,
        "tolerance": 1e-9,
    }
    (peaks,) = Computed(document).ends[0].peaks
    # as high as it was let go, to what 1e-9 makes of two impacts on a clearance of 5e-4 m
    assert abs(peaks[2]) < 1e-8
    assert 0.016 < peaks[3] < 0.03


def test_a_continuation_goes_on_where_its_neighbour_stopped() -> None:
    """With one value twice it is one long run, but for the first step after the handing over."""
    observables = ["A.eccentricity_x", "A.eccentricity_y", "B.eccentricity_x", "B.eccentricity_y"]
    values = {"values": [5e-4, 5e-4], "record": 1, "settle": 0, "observables": observables}
    forward = Computed(DIAGRAM | values | {"continuation": "forward", "chains": 1})
    long = Computed(DIAGRAM | values | {"values": [5e-4], "record": 2})
    assert [forward.ends[i].statistics["from_neighbour"] for i in (0, 1)] == [0.0, 1.0]
    # the end of the first run shortens a step: another sequence of steps from there, so that the
    # tolerance shows, 1e-6 of the clearance, and then what a revolution of contact makes of it
    assert np.all(np.abs(forward.sections(0) - long.sections(0)[:1]) < 1e-9)
    assert np.all(np.abs(forward.sections(1) - long.sections(0)[1:]) < 1e-7)


def test_both_directions_start_their_chains_by_the_start_rule() -> None:
    both = Computed(DIAGRAM | {"continuation": "both", "chains": 2, "record": 1, "settle": 0})
    flags = [both.ends[point].statistics["from_neighbour"] for point in range(20)]
    assert flags[:10] == [0, 1, 1, 1, 1, 0, 1, 1, 1, 1]
    assert flags[10:] == [1, 1, 1, 1, 0, 1, 1, 1, 1, 0]


def test_sections_at_onsets_are_the_impacts_of_a_single_run() -> None:
    document = DIAGRAM | {"kind": "poincare", "section": {"onset": "A"}, "settle": 0, "record": 8}
    document = {key: document[key] for key in document if key not in ("parameter", "values")}
    found = Computed(document | {"observables": ["A.penetration"]})
    _, slices, _ = run_alone(0.5, clearance=5e-4)
    impacts = np.concatenate([piece.impacts for piece in slices])
    onsets = np.sort(impacts["onset"][impacts["joint"] == 0])[:8]
    assert np.concatenate(found.times[0]).tolist() == onsets.tolist()
    assert np.all(np.abs(found.sections(0)[:, 0]) < 1e-12)  # a section is taken at the touch


def test_sections_at_a_crossing_have_the_channel_at_its_value() -> None:
    section = {"channel": "displacement", "value": 0.3, "direction": "up"}
    document = {"kind": "poincare", "scene": SCENE, "section": section, "settle": 1, "record": 3}
    found = Computed(document | {"observables": ["displacement", "velocity"]})
    values, times = found.sections(0), np.concatenate(found.times[0])
    assert len(values) == 3
    assert np.all(np.abs(values[:, 0] - 0.3) < 1e-12)  # located to 1e-13 of a step of 1e-4 s
    assert np.all(values[:, 1] > 0.0)
    assert times[0] > PERIOD
    assert np.all(np.abs(np.diff(times) - PERIOD) < 1e-2)


def test_an_ensemble_starts_apart_and_its_first_member_at_the_scene_s_start() -> None:
    document = {"kind": "ensemble", "scene": SCENE, "members": 3, "seed": 1, "settle": 0}
    members = Computed(document | {"record": 1})
    alone = Computed({"kind": "poincare", "scene": SCENE, "settle": 0, "record": 1})
    assert members.sections(0).tobytes() == alone.sections(0).tobytes()
    assert len({members.sections(i).tobytes() for i in range(3)}) == 3


def test_settling_says_how_long_it_took_and_why() -> None:
    settled = Computed(DIAGRAM | {"values": [5e-4], "settle": "auto", "record": 2}).ends[0]
    assert settled.statistics["settling"] in (1.0, 2.0)
    periods = settled.statistics["settled_periods"]
    assert periods % 16 == 0
    assert settled.time == (periods + 2) * PERIOD


@pytest.mark.parametrize("section", [{}, {"crank_angle": 1.0}])
def test_sections_behind_settling_that_is_waited_for_are_those_of_as_many_periods(
    section: dict[str, float],
) -> None:
    job = DIAGRAM | {"values": [5e-4], "record": 2, "section": section}
    found = Computed(job | {"settle": "auto"})
    periods = int(found.ends[0].statistics["settled_periods"])
    share = section.get("crank_angle", 0.0) / (2.0 * np.pi)
    expected = (periods + np.array([1.0, 2.0]) + share) * PERIOD
    np.testing.assert_allclose(np.concatenate(found.times[0]), expected, rtol=1e-14)
    assert found.ends[0].time == pytest.approx(expected[-1], rel=1e-14)
    given = Computed(job | {"settle": periods})
    np.testing.assert_allclose(np.concatenate(given.times[0]), expected, rtol=1e-14)


def test_a_value_that_fails_leaves_the_others_standing() -> None:
    # stiff beyond reason, full friction at any slip: the step cannot cross the jump of friction
    hopeless = {"stiffness": 1e18, "friction": 10.0, "static_velocity": 0.0}
    hopeless |= {"dynamic_velocity": 1e-12}
    sound = {"stiffness": 1e8, "friction": 0.1, "static_velocity": 1e-3, "dynamic_velocity": 1e-2}
    fixed = {"restitution": 1.0, "velocity_x": 0.1, "spin": 1000.0}
    document = {
        "kind": "sweep",
        "scene": {"preset": "bouncing-journal", "parameters": fixed},
        "points": [hopeless, sound],
        "duration": 0.05,
        "tolerance": 1e-10,
    }
    found = Computed(document)
    assert found.ends[0].code == "step-size-underflow"
    assert "dynamic_velocity" in found.ends[0].detail
    assert 0.0 < found.ends[0].time < 0.05
    assert np.all(np.isfinite(found.ends[0].peaks))  # what it computed is kept
    assert found.ends[1].code == ""
    assert found.ends[1].time == 0.05
