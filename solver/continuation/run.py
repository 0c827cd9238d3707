"""The branches of a continuation in slices, for a worker: interrupted and continued at any."""

import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import lru_cache

import numpy as np
from greenlet import getcurrent, greenlet

from jointplay.records.checkpoint import decode, encode
from jointplay.records.point import PointEnd, SectionRows, StudySlice
from jointplay.solver.continuation.branch import Row, both_ways
from jointplay.solver.continuation.crossing import Crossing
from jointplay.solver.continuation.doubling import behind_doubling
from jointplay.solver.continuation.first_orbits import first_orbits
from jointplay.solver.continuation.orbit import Orbit, Way
from jointplay.solver.continuation.plan import COUNTED, ContinuationStudy, Reach, Second
from jointplay.solver.continuation.section_map import SectionMap
from jointplay.solver.continuation.section_runs import Answers
from jointplay.solver.continuation.settled import NoStart
from jointplay.solver.continuation.slips import friction_slips
from jointplay.solver.continuation.special_curve import starts_of_curves
from jointplay.solver.continuation.switching import beside_branch_point
from jointplay.solver.continuation.table import document_of, row_of
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.runs.study.crossing import crossing_event
from jointplay.solver.runs.study.scenes import PointScenes
from jointplay.solver.scene.document import Scene
from jointplay.solver.version import SOLVER_VERSION

_KIND = "continuation"
NO_PEAKS = np.empty((0, 4))
KEPT_SCENES = 16
NOTHING = "There is no first branch whose special orbits could be followed."
FULL = "as many orbits as a branch may have; ask for a larger 'record'"


class ContinuationRun:
    """The block of a continuation; `slices` computes it, `checkpoint` keeps what runs have said.

    Following a branch cannot be left in between; it runs in a greenlet, which hands back to
    `slices` whenever the lanes were looked at.  All decisions follow from the answers of the
    section map, so that one that is continued asks for those that are kept again, in that order.
    """

    def __init__(
        self, study: ContinuationStudy, block: int, checkpoint: bytes | None = None
    ) -> None:
        """Begin the branches, or take up after the last answer that was known."""
        self.study = study
        self._scene_at = scenes_of(study)
        self.seconds = 0.0
        """Spent computing since this object was made."""
        self.steps = 0.0
        """Accepted since then."""
        self._answers: list[Answers] = []
        self._fresh: list[StudySlice] = []
        self._given = 0
        """Slices with news that were handed out, of the whole continuation."""
        self._spent = 0.0
        if checkpoint is not None:
            facts, saved = decode(checkpoint, _KIND, SOLVER_VERSION)
            parts = np.split(saved["answers"], np.cumsum([r * c for r, c in facts["shapes"]]))
            self._answers = [
                (part.reshape(shape), failures)
                for part, shape, failures in zip(
                    parts, facts["shapes"], facts["failures"], strict=False
                )
            ]
            self._given = facts["given"]
        self._known = iter(list(self._answers))
        self._skipped = self._given
        self._reached = 0.0
        self._first: list[Orbit | NoStart] = []
        """Where branches of their own begin that are not followed yet; or why one is none."""
        self._observed = np.zeros(0, np.int64)
        """Observables, by their indices in the kernel's block of channels."""

    def slices(self) -> Iterator[StudySlice]:
        """Yield how far the branches are after each look at the lanes, and orbits when found.

        Raises
        ------
        LimitExceeded
            The scene's equations are too long to compile.
        """
        map_ = section_map(self.study, self._looked, self._recall)
        names = self.study.job["observables"]
        self._observed = np.array([map_.kernel.rows.index(name) for name in names], np.int64)
        following = greenlet(self._branches)
        worked = time.process_time()
        following.switch(map_)
        while True:
            self.seconds += time.process_time() - worked
            if not (self._fresh or following.dead):
                yield StudySlice(self._reached, (), (), ())
            while self._fresh:
                self._given += 1
                yield self._fresh.pop(0)
            if following.dead:
                return
            worked = time.process_time()
            following.switch()

    def checkpoint(self) -> bytes:
        """Return a restart point; valid between slices."""
        facts = {
            "shapes": [numbers.shape for numbers, _ in self._answers],
            "failures": [failures for _, failures in self._answers],
            "given": self._given,
        }
        flat = [np.empty(0), *(numbers.reshape(-1) for numbers, _ in self._answers)]
        return encode(_KIND, SOLVER_VERSION, facts, {"answers": np.concatenate(flat)})

    def _looked(self) -> None:
        getcurrent().parent.switch()

    def _recall(self, compute: Callable[[], Answers]) -> Answers:
        known = next(self._known, None)
        if known is None:
            known = compute()
            self._answers.append(known)
            self.steps += float(known[0][:, -1].sum())
        self._spent += float(known[0][:, -1].sum())
        return known

    def _branches(self, map_: SectionMap) -> None:
        """Follow every branch, then curves of the first one's special orbits."""
        study, reach = self.study, self.study.reach
        branches: list[list[Row]] = []
        for point in range(study.points - study.curves):
            self._tell(StudySlice(self._fraction(point, 0), (point,), (), ()))
            rows: list[Row] = []
            spent, failure = self._spent, ""
            try:
                start, ways = self._start(map_, branches)
            except NoStart as none:
                failure = str(none)
            else:
                self._follow(point, rows, start, both_ways(start, ways, reach))
            branches.append(rows)
            self._end(point, rows, spent, failure)
        if study.second is not None:
            self._curves(study.second, branches[0])

    def _start(self, map_: SectionMap, branches: list[list[Row]]) -> tuple[Row, list[Way]]:
        """Return the first orbit of the branch behind others, and the ways from there."""
        study, point = self.study, len(branches)
        if point == 0:
            given = study.job["state"]
            state = None if given is None else np.array(given, np.float64)
            settle = study.job["settle"]
            self._first = first_orbits(map_, study.start, state, settle, study.orbits)
        if point == 0 or point > study.points - study.curves - study.orbits:
            ways = self._ways_from(self._first.pop(0))
        elif point > study.doublings:
            return beside_branch_point(branches[0], point - study.doublings - 1)
        else:
            ways = [behind_doubling(branches[-1])]
        return Row(ways[0][0], 0.0, "EP", note="start of the branch"), ways

    def _curves(self, second: Second, branch: list[Row]) -> None:
        """Follow special orbits of the first branch over the second parameter, each curve once."""
        curves: list[list[Row]] = []
        starts = starts_of_curves(branch, second, self._scene_at, curves)
        for point in range(self.study.points - second.curves, self.study.points):
            self._tell(StudySlice(self._fraction(point, 0), (point,), (), ()))
            rows: list[Row] = []
            spent, failure = self._spent, "" if branch else NOTHING
            start = next(starts, None)
            if isinstance(start, NoStart):
                failure = str(start)
            elif start is not None:
                ways = _ways(start.orbit, second.start, second.reach)
                self._follow(point, rows, start, both_ways(start, ways, second.reach))
            curves.append(rows)
            self._end(point, rows, spent, failure)

    def _follow(self, point: int, rows: list[Row], start: Row, found: Iterator[Row]) -> None:
        """Tell of a branch from its start, until it ends or has as many orbits as it may have."""
        self._take(point, rows, start)
        for row in found:
            last = len(rows) + 1 == self.study.record
            self._take(point, rows, _last(row) if last else row)
            if last:
                break

    def _ways_from(self, orbit: Orbit | NoStart) -> list[Way]:
        """Return an orbit with the ways from there, that towards the range's 'to' first."""
        if isinstance(orbit, NoStart):
            raise orbit
        ways = _ways(orbit, self.study.start, self.study.reach)
        return ways if self.study.job["values"]["from"] == self.study.reach.low else ways[::-1]

    def _take(self, point: int, rows: list[Row], row: Row) -> None:
        """Tell of an orbit that was found."""
        second = self.study.second
        values = row.orbit.values[:1] if second is None else (*row.orbit.values, second.start)[:2]
        channels = row.orbit.curve.sections.observed(row.orbit.section, self._observed)
        numbers = np.append(row_of(row, values[1:]), channels)
        period = float(self.study.period[point])
        elapsed = np.array([(self.study.job["settle"] + len(rows)) * period])
        news = SectionRows(point, len(rows), elapsed, numbers[None])
        rows.append(row)
        self._tell(StudySlice(self._fraction(point, len(rows)), (), (news,), ()))

    def _end(self, point: int, rows: list[Row], spent: float, failure: str = "") -> None:
        code = "no-orbit" if failure else ""
        until = float(self.study.period[point]) * (self.study.job["settle"] + len(rows))
        numbers: dict[str, float] = {"steps": self._spent - spent, "orbits": float(len(rows))}
        for label, name in COUNTED.items():
            numbers[name] = float(sum(row.label == label for row in rows[1:]))
        document = None if failure else document_of(rows)
        end = PointEnd(point, code, failure, until, NO_PEAKS, numbers, {}, document=document)
        self._tell(StudySlice(self._fraction(point + 1, 0), (), (), (end,)))

    def _tell(self, news: StudySlice) -> None:
        """Hand out news, unless they were before this object was made."""
        if self._skipped:
            self._skipped -= 1
        else:
            self._fresh.append(news)

    def _fraction(self, point: int, rows: int) -> float:
        """Return how much is done, 0..1; it never falls."""
        share = min(rows / self.study.record, 0.99)
        self._reached = max(self._reached, (point + share) / self.study.points)
        return self._reached


def _ways(orbit: Orbit, value: float, reach: Reach) -> list[Way]:
    """Return an orbit with the ways from there to both ends of a range, or to one."""
    ways = []
    for sense, end in ((1.0, reach.high), (-1.0, reach.low)):
        if sense * (end - value) > 0.0:
            axis = np.zeros(len(orbit.vector))
            axis[-1] = sense
            ways.append((orbit, axis))
    return ways


def scenes_of(study: ContinuationStudy) -> Callable[..., Scene]:
    """Return what gives the scene of values of what varies."""
    scenes = study.scenes

    @lru_cache(maxsize=KEPT_SCENES)
    def scene_at(*values: float) -> Scene:
        return PointScenes(scenes.base, scenes.leaves, np.array([values])).scene(0)

    return scene_at


def section_map(
    study: ContinuationStudy,
    looked: Callable[[], None] = lambda: None,
    recall: Callable[[Callable[[], Answers]], Answers] = lambda compute: compute(),
) -> SectionMap:
    """Return the section map of a study, in scales of one; see `SectionMap`.

    LimitExceeded: the scene's equations are too long to compile.
    """
    scene = study.point_scene(0)
    kernel = ready_kernel(scene, study.job["formulation"], study.method)
    second = () if study.second is None else (study.second.start,)
    scenes = scenes_of(study)

    def scene_at(value: float) -> Scene:
        return scenes(value, *second)

    ones = np.ones(kernel.states + len(kernel.pairs))
    width = study.reach.high - study.reach.low
    section = study.job["section"]
    return SectionMap(
        kernel,
        scene_at,
        study.job["period"],
        study.tolerance,
        ones,
        width,
        looked=looked,
        recall=recall,
        has_friction=bool(friction_slips(scene)),
        crossing=section and Crossing(crossing_event(kernel, section), float(study.period[0])),
        angles=tuple(k for k, one in enumerate(kernel.coordinates) if one.endswith(".theta")),
    )


def _last(row: Row) -> Row:
    """Return the last orbit that a branch may have; a special one stays what it is."""
    return replace(row, label=row.label or "EP", note="; ".join(filter(None, (row.note, FULL))))
