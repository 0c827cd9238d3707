"""A block that many lanes of a device have begun goes on in eight lanes here, bit for bit."""

from dataclasses import replace
from typing import Any, cast

from jointplay.records.point import PointEnd
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.loop.bundle import Bundle
from jointplay.solver.kinds import admit
from jointplay.solver.runs.study.lane_group import LaneGroup
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.study.run import StudyRun
from tests.solver.kernels.device.test_device_bundle import on_device

POINTS = 12


def chart() -> Study:
    """Return a chart of one block, with exponents."""
    along = {"parameter": "clearance", "values": {"from": 2e-4, "to": 4e-4, "count": POINTS}}
    by = {"parameter": "speed", "values": [200.0]}
    job = {
        "kind": "chart",
        "scene": {"preset": "slider-crank"},
        "along": along,
        "by": by,
        "settle": 1,
        "record": 3,
        "tolerance": 1e-5,
    }
    return replace(cast(Study, admit(job)), blocks=((0, POINTS),))


def of_a_device(kernel: Kernel, *, tangents: Any, watch: bool, keep_steps: int) -> Bundle:
    assert not watch
    assert not keep_steps
    return on_device(kernel, POINTS, tangents=tangents)


def ends(run: StudyRun) -> dict[int, PointEnd]:
    return {end.point: end for piece in run.slices() for end in piece.ended}


def told(found: dict[int, PointEnd]) -> dict[int, tuple[Any, ...]]:
    return {p: (repr(end.statistics), repr(end.indicators), end.time) for p, end in found.items()}


def test_a_block_begun_by_a_device_goes_on_here() -> None:
    study = chart()
    run = StudyRun(study, 0)
    run.group = LaneGroup(study, 0, of_a_device)
    piece = next(run.slices())
    assert len(piece.started) == POINTS
    assert not piece.ended
    found = ends(StudyRun(study, 0, run.checkpoint()))
    assert len(found) == POINTS
    assert told(found) == told(ends(StudyRun(study, 0)))
