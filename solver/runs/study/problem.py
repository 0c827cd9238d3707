"""The problem that a lane gets of a point: all of it, or the time until the point settles."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from jointplay.records.arrays import Flags, Floats
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.emit.tangents import Tangents
from jointplay.solver.kernels.loop.runs import SectionKind
from jointplay.solver.lanes.binding import own_start
from jointplay.solver.lanes.problem import Event, LaneProblem, LaneStart
from jointplay.solver.lanes.ready_lanes import ReadyLanes, make_ready
from jointplay.solver.runs.starts import perturbed_start, start_scales
from jointplay.solver.runs.study.crossing import crossing_event
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.study.point_run import PointRun, begin_tallies, stretch_of
from jointplay.solver.scene.document import Scene
from jointplay.solver.statistics import OF_CHANNELS

ENDLESS = 2**62
"""More sections than any run takes."""
WINDOW = 16
"""Periods between two looks at whether a point has settled."""


def begin_point(study: Study, kernel: Kernel, run: PointRun) -> None:
    """Note how far the first leg of a point goes, and give it its tallies."""
    if study.statistics:
        begin_tallies(study, run, len(kernel.pairs))
    if study.record == 0:
        run.reached = run.settled = 0
    elif study.job["settle"] == "auto":
        run.reached = min(WINDOW, most_settling(study, run.point))
    else:
        run.settled = int(study.job["settle"])


def ready(study: Study, kernel: Kernel, tangents: Tangents | None, points: list[int]) -> ReadyLanes:
    """Return lanes of points of one structure that have no neighbour to follow."""
    scenes = study.scenes.at_rows(np.array(points))
    scene = scenes.together()
    problems = [problem_of(study, kernel, point, scene) for point in points]
    return make_ready(kernel, tangents, problems, scenes.scene)


def problem_of(
    study: Study, kernel: Kernel, point: int, scene: Scene, start: LaneStart | None = None
) -> LaneProblem:
    """Return what a lane computes first of a point: all of it, or the time until it settles."""
    if study.perturbation is not None and study.starts == 1:
        start = LaneStart(perturbed(study, kernel, point, point))
    duration = float(study.duration[point])
    sections, offset, first, event = 0, 0.0, 0, None
    if study.record > 0:
        offset, event = float(study.offset[point]), _event(study, kernel, point)
        waits = study.job["settle"] == "auto"
        if waits:
            reached = min(WINDOW, most_settling(study, point))
            duration, sections, first = reached * float(study.period[point]), ENDLESS, 1
        else:
            first = int(study.job["settle"]) + 1
            sections = first + study.record
        if event is not None:
            first, sections = 0, ENDLESS if waits else study.record
    step, samples, first_sample = _sampled(study, point, duration)
    return LaneProblem(
        scene,
        duration,
        study.tolerance,
        step,
        samples,
        sections,
        offset,
        first,
        event,
        start,
        first_sample=first_sample,
        ledger=study.keeps_ledger,
        tangent_forgets=_settling(study),
    )


def _settling(study: Study) -> int:
    """Return the periods before the record, 1 at least; 0: not known, or there are no tangents."""
    if not study.carries_exponents or study.job["settle"] == "auto":
        return 0
    return max(int(study.job["settle"]), 1)


def _sampled(study: Study, point: int, duration: float) -> tuple[float, int, int]:
    """Return step, number and first of the samples that statistics of channels need."""
    if OF_CHANNELS.keys().isdisjoint(study.statistics):
        return duration, 0, 0
    stretch = stretch_of(study, point)
    samples = stretch.first + stretch.grid.samples + 1  # the last one is taken at the end
    return stretch.step, samples, stretch.first


def scales_of(study: Study, kernel: Kernel, point: int) -> tuple[Floats, Flags]:
    """Return what counts as one in each state, and which states are angles, (states,) each."""
    scene, period = study.point_scene(point), float(study.period[point])
    scales = start_scales(scene, kernel.coordinates, period, scene.length)
    angles = np.zeros(len(scales), dtype=bool)
    angles[: len(kernel.coordinates)] = [name.endswith(".theta") for name in kernel.coordinates]
    return scales, angles


def most_settling(study: Study, point: int) -> int:
    """Return how many periods a point may take to settle."""
    return max(1, round(float(study.settle[point] / study.period[point])))


def _event(study: Study, kernel: Kernel, point: int) -> Event | None:
    section: Mapping[str, Any] = study.job["section"]
    waits = study.job["settle"] == "auto"
    not_before = 0.0 if waits else float(study.settle[point])
    if "onset" in section:
        pair = kernel.pairs.index(section["onset"])
        return Event(SectionKind.ONSET, pair, not_before=not_before)
    return crossing_event(kernel, section, not_before) if "channel" in section else None


def perturbed(study: Study, kernel: Kernel, point: int, member: int) -> Floats:
    """Return the start of a member of an ensemble, or one of several starts of a point."""
    assert study.perturbation is not None  # noqa: S101  (narrows the type)
    scene = study.point_scene(point)
    state = own_start(kernel, scene)
    period = float(study.period[point])
    scales = start_scales(scene, kernel.coordinates, period, scene.length)
    return perturbed_start(state, scales, study.perturbation, member)
