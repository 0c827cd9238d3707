"""Many lanes of a device compute blocks together, with the bits that each has in eight lanes."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any, cast

import numpy as np
import pytest

from jointplay.records.point import StudySlice
from jointplay.solver.computations import computation_of
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kinds import admit
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.study.pool import Pool
from jointplay.solver.runs.study.run import StudyRun
from tests.solver.lanes.test_device_bundle import on_device

LANES = 10
SHORT = 1e-9
"""Seconds of a slice that make all but the first as short as they may be."""
OSCILLATOR = {
    "kind": "chart",
    "scene": {"preset": "impact-oscillator"},
    "along": {"parameter": "speed", "values": {"from": 24.0, "to": 40.0, "count": 9}},
    "by": {"parameter": "amplitude", "values": {"from": 2e-3, "to": 9e-3, "count": 5}},
    "settle": 10,
    "record": 6,
    "statistics": ["impacts"],
    "tolerance": 1e-5,
}
CRANK = {
    "kind": "chart",
    "scene": {"preset": "slider-crank"},
    "along": {"parameter": "clearance", "values": {"from": 2e-4, "to": 4e-4, "count": 12}},
    "by": {"parameter": "speed", "values": [200.0]},
    "settle": 1,
    "record": 3,
    "tolerance": 1e-5,
}
JOBS = {
    "exponents of the oscillator": OSCILLATOR,
    "two tiles of a refined chart": OSCILLATOR
    | {"refine": 2, "indicators": ["recurrence"]}
    | {"along": {"parameter": "speed", "values": {"from": 24.0, "to": 40.0, "count": 67}}},
    "exponents beside sections at onsets": {
        "kind": "bifurcation",
        "scene": {"preset": "slider-crank"},
        "parameter": "clearance",
        "values": {"from": 1e-4, "to": 5e-4, "count": 12},
        "section": {"onset": "P"},
        "indicators": ["lyapunov"],
        "settle": 1,
        "record": 3,
        "tolerance": 1e-5,
    },
    "settling that is waited for": CRANK | {"settle": "auto", "indicators": ["recurrence"]},
    "sections that are kept": {
        "kind": "bifurcation",
        "scene": {"preset": "slider-crank"},
        "parameter": "clearance",
        "values": {"from": 1e-4, "to": 5e-4, "count": 17},
        "continuation": "both",
        "chains": 5,
        "settle": 1,
        "record": 3,
        "tolerance": 1e-5,
    },
}


def of_a_device(kernel: Kernel, *, tangents: Any, watch: bool, keep_steps: int) -> Bundle:
    assert not watch
    assert not keep_steps
    return on_device(kernel, LANES, tangents=tangents)


def study_of(document: dict[str, Any]) -> Study:
    return cast(Study, admit(document))


def told(pieces: list[StudySlice]) -> list[Any]:
    """Return all that slices tell of points, whatever the slices were."""
    sections: dict[int, list[bytes]] = {}
    for rows in (rows for piece in pieces for rows in piece.rows):
        columns = np.column_stack([rows.time, rows.values])
        sections.setdefault(rows.point, []).append(columns.tobytes())
    ends = [end for piece in pieces for end in piece.ended]
    return [
        (repr(replace(end, peaks=None)), b"".join(sections.get(end.point, [])))
        for end in sorted(ends, key=lambda end: end.point)
    ]


def pooled(study: Study, blocks: list[StudyRun]) -> Iterator[list[tuple[StudyRun, StudySlice]]]:
    """Yield what lanes of a device compute of blocks; others are added as there is room."""
    pool, waiting = Pool(study, of_a_device, SHORT), list(blocks)
    while waiting or pool.runs:
        while waiting and pool.room > 0:
            pool.add(waiting.pop(0))
        yield pool.advance()


@pytest.mark.parametrize("name", JOBS)
def test_blocks_have_the_bits_that_they_have_alone(name: str) -> None:
    study = study_of(JOBS[name])
    assert len(study.blocks) > 1
    assert study.points > LANES
    runs = [cast(StudyRun, computation_of(study, k)) for k in range(len(study.blocks))]
    found: dict[int, list[StudySlice]] = {}
    together = 0
    for pieces in pooled(study, runs):
        together = max(together, len(pieces))
        for run, piece in pieces:
            found.setdefault(run.block, []).append(piece)
    assert together > 1
    for block in range(len(study.blocks)):
        alone = list(computation_of(study, block).slices())
        assert found[block][-1].fraction == 1.0
        assert told(found[block]) == told(alone)


def test_blocks_that_a_device_has_begun_go_on_here() -> None:
    """From restart points of their own, in the midst of their points, and the other way round."""
    study = study_of(CRANK)
    runs = [StudyRun(study, block) for block in range(2)]
    begun: list[list[StudySlice]] = [[], []]
    slices = pooled(study, runs)
    for _ in range(3):
        for run, piece in next(slices):
            begun[run.block].append(piece)
    assert all(run.group is not None and run.group.computes(run.block) for run in runs)
    here = StudyRun(study, 0, runs[0].checkpoint())
    begun[0].append(next(here.slices()))
    again = [StudyRun(study, 0, here.checkpoint()), StudyRun(study, 1, runs[1].checkpoint())]
    assert all(run.lane is not None for run in again[0].waiting)
    for pieces in pooled(study, again):
        for run, piece in pieces:
            begun[run.block].append(piece)
    for block in range(2):
        assert told(begun[block]) == told(list(StudyRun(study, block).slices()))


def test_a_pool_of_blocks_without_lanes_takes_one_first() -> None:
    study = study_of(OSCILLATOR)
    pool = Pool(study, of_a_device)
    assert pool.room == 1
    pool.add(StudyRun(study, 0))
    assert pool.room == 0
