"""Answers questions about trajectories: by the steps made again, or the ideal motion."""

from functools import lru_cache

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.failure import InvalidInput, SimulationFailed
from jointplay.solver.integrators import METHODS
from jointplay.solver.kernels.watched import CompilationEnded
from jointplay.solver.kinds import Admission, parse
from jointplay.solver.runs.dense_output.exact_motion import ExactMotion
from jointplay.solver.runs.dense_output.moments import moments_of
from jointplay.solver.runs.dense_output.replay import Replay
from jointplay.solver.runs.dense_output.stretches import spread, stretches, widest
from jointplay.worker.windows.question import Answer, Question

_MOST_KEPT = 8
"""Mechanisms that a process has ready: of jobs that somebody looks at now."""
SAME = 1e-6
"""Largest difference, in scales of a state, at which a step made again is still the run's."""


def answer(question: Question) -> Answer:
    """Return what was asked for; a refusal where these steps cannot be made again."""
    try:
        if question.steps is None:
            return Answer(_of_motion(_motion(_Document(question.job)), question))
        return _of_stretches(question, question.steps)
    except (InvalidInput, SimulationFailed, CompilationEnded) as error:
        return Answer(None, refused=str(error))


def _of_stretches(question: Question, steps: Floats) -> Answer:
    """Make each stretch of steps again with its method; their answers are one."""
    pieces = []
    for part in stretches(steps[:, -1]):
        method = dict(enumerate(question.methods)).get(int(steps[part.start, -1]))
        if method is None or method not in METHODS:
            return Answer(None, refused=f"This version of the solver has no method {method!r}.")
        rows = np.ascontiguousarray(steps[part, :-1])
        pieces.append((_replay(_Document(question.job), method), rows))
    if any(rows.shape[1] != replay.width for replay, rows in pieces):
        return Answer(None, refused="This version of the solver makes other steps.")
    off = max(replay.mismatch(rows) for replay, rows in pieces)
    if not off <= SAME:
        return Answer(None, refused="This version of the solver makes other steps.")
    return Answer(_of_steps(pieces, question), rounded=off > 0.0)


def _of_steps(pieces: list[tuple[Replay, Floats]], question: Question) -> Floats:
    if question.times is not None:
        begins = [float(replay.begins(rows[:1])[0]) for replay, rows in pieces]
        asked = spread(question.times, begins)
        admission = _admitted(_Document(question.job))
        found = [
            replay.channels(question.names, rows, moments_of(admission, times))
            for (replay, rows), times in zip(pieces, asked, strict=True)
        ]
        return np.concatenate(found)
    if question.edges is None:
        works = [np.column_stack([each.ends(rows), each.works(rows)]) for each, rows in pieces]
        return np.concatenate(works)
    ranges = np.zeros(len(question.names)) if question.ranges is None else question.ranges
    names, edges, evaluated = question.names, question.edges, question.evaluated
    return widest(
        [each.extremes(names, rows, edges, ranges, evaluated=evaluated) for each, rows in pieces]
    )


def _of_motion(motion: ExactMotion, question: Question) -> Floats:
    if question.times is not None:
        return motion.channels(question.names, question.times)
    assert question.edges is not None  # noqa: S101
    return motion.extremes(question.names, question.edges)


class _Document(dict):  # type: ignore[type-arg]
    """A job's document that caches know by what it says."""

    def __hash__(self) -> int:  # type: ignore[override]
        return hash(repr(self))


@lru_cache(maxsize=_MOST_KEPT)
def _admitted(job: _Document) -> Admission:
    found = parse(dict(job))
    assert isinstance(found, Admission)  # noqa: S101  (points have no trajectory)
    return found


@lru_cache(maxsize=_MOST_KEPT)
def _replay(job: _Document, method: str) -> Replay:
    return Replay(_admitted(job), method)


@lru_cache(maxsize=_MOST_KEPT)
def _motion(job: _Document) -> ExactMotion:
    return ExactMotion(_admitted(job))
