"""Restart points of a block: its points that wait, and those under way with their lanes.

Lanes do not touch each other: a restart point of many lanes goes on in eight, and the other way
round, bit for bit.
"""

from collections.abc import Collection
from dataclasses import asdict
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.checkpoint import decode, encode
from jointplay.records.point import PointEnd
from jointplay.solver.lanes.bundle import LaneState
from jointplay.solver.lanes.problem import LaneStart
from jointplay.solver.runs.study.lane_group import LaneGroup
from jointplay.solver.runs.study.point_extremes import STATE
from jointplay.solver.runs.study.point_run import PointRun
from jointplay.solver.version import SOLVER_VERSION

_KIND = "block of a study"
SERIES = ("seen", "moments", "growth", "finer", "tallies", "rest")
"""Lists of arrays of a point's run that a restart point needs."""
PARTS = ("column", "run", "first_energy")
"""Arrays of a lane, in the order of `PointRun.lane`."""


def written(
    ended: int, waiting: Collection[PointRun], group: LaneGroup | None, block: int
) -> bytes:
    """Return a restart point of a block, of which so many points have ended."""
    under_way = [] if group is None else _under_way(group, block)
    resumed = [(run, run.lane) for run in waiting if run.lane is not None]
    states = [*under_way, *resumed]
    begun = [run for run, _ in states]
    waiting = [run for run in waiting if run.lane is None]
    arrays: dict[str, NDArray[Any]] = {}
    for run in [*waiting, *begun]:
        for name in SERIES:
            parts = getattr(run, name)
            arrays |= {f"{name}{run.point}-{i}": part for i, part in enumerate(parts)}
        arrays |= {f"{name}-{run.point}": array for name, array in run.extremes.items()}
        if run.start is not None:
            arrays |= {
                f"start{run.point}-{name}": value
                for name, value in asdict(run.start).items()
                if value is not None
            }
    facts = {
        "ended": ended,
        "waiting": [_facts(run) for run in waiting],
        "lanes": [_facts(run) for run in begun],
    }
    for k, part in enumerate(PARTS):
        arrays |= {f"{part}-{run.point}": np.asarray(state[k]) for run, state in states}
    return encode(_KIND, SOLVER_VERSION, facts, arrays)


def _under_way(group: LaneGroup, block: int) -> list[tuple[PointRun, LaneState]]:
    """Return the runs that lanes compute, with where these have come to."""
    runs = group.runs_of(block)
    return list(zip(runs.values(), group.bundle.states_of(list(runs)), strict=True))


def read(checkpoint: bytes) -> tuple[int, list[PointRun]]:
    """Return how many points have ended, and those that go on or wait."""
    facts, arrays = decode(checkpoint, _KIND, SOLVER_VERSION)
    begun = [_run(found, arrays) for found in facts["lanes"]]
    for run in begun:
        column, record, energy = (arrays[f"{part}-{run.point}"] for part in PARTS)
        run.lane = column, record[()], energy
    waiting = [_run(found, arrays) for found in facts["waiting"]]
    return facts["ended"], [*begun, *waiting]


def _facts(run: PointRun) -> dict[str, Any]:
    names = (
        "point",
        "chain",
        "position",
        "settled",
        "reached",
        "taken",
        "sampled",
        "finer_from",
        "lasting",
    )
    facts = {name: getattr(run, name) for name in names}
    facts |= {name: len(getattr(run, name)) for name in SERIES}
    ended = run.ended and facts_of_end(run.ended)
    tried = [facts_of_end(one) for one in run.tried]
    return facts | {"starts": run.start is not None, "ended": ended, "tried": tried}


def _run(facts: dict[str, Any], arrays: dict[str, NDArray[Any]]) -> PointRun:
    starts, ended, tried = (facts.pop(name) for name in ("starts", "ended", "tried"))
    counts = {name: facts.pop(name) for name in SERIES}
    run = PointRun(**facts)
    for name, count in counts.items():
        setattr(run, name, [arrays[f"{name}{run.point}-{i}"] for i in range(count)])
    kept = {name: f"{name}-{run.point}" for name in STATE}
    run.extremes = {name: arrays[place] for name, place in kept.items() if place in arrays}
    run.ended = end_of_facts(ended) if ended else None
    run.tried = [end_of_facts(one) for one in tried]
    if starts:
        names = ("state", "contact", "impact_rate")
        clock = (arrays[f"start{run.point}-{name}"].item() for name in ("period", "time"))
        run.start = LaneStart(*(arrays.get(f"start{run.point}-{name}") for name in names), *clock)  # type: ignore[arg-type]
    return run


def facts_of_end(end: PointEnd) -> dict[str, Any]:
    """Return the end of a point as JSON has it."""
    return {**asdict(end), "peaks": end.peaks.tolist()}


def end_of_facts(fields: dict[str, Any]) -> PointEnd:
    """Return the end of a point that was written as `facts_of_end` has it."""
    peaks = np.array(fields.pop("peaks")).reshape(-1, 4)
    return PointEnd(**fields, peaks=peaks)
