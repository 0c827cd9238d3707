"""Answers questions about trajectories: by the steps made again, or the ideal motion."""

from functools import lru_cache

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.failure import InvalidInput, SimulationFailed
from jointplay.solver.integrators import METHODS
from jointplay.solver.kernels.watched import CompilationEnded
from jointplay.solver.kinds import Admission, parse
from jointplay.solver.runs.dense_output.exact_motion import ExactMotion
from jointplay.solver.runs.dense_output.replay import Replay
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
        (number,) = np.unique(question.steps[:, -1])
        method = dict(enumerate(question.methods)).get(int(number))
        if method is None or method not in METHODS:
            return Answer(None, refused=f"This version of the solver has no method {method!r}.")
        replay = _replay(_Document(question.job), method)
        steps = np.ascontiguousarray(question.steps[:, :-1])
        if steps.shape[1] != replay.width:
            return Answer(None, refused="This version of the solver makes other steps.")
        off = replay.mismatch(steps)
        if not off <= SAME:
            return Answer(None, refused="This version of the solver makes other steps.")
        return Answer(_of_steps(replay, steps, question), rounded=off > 0.0)
    except (InvalidInput, SimulationFailed, CompilationEnded) as error:
        return Answer(None, refused=str(error))


def _of_steps(replay: Replay, steps: Floats, question: Question) -> Floats:
    if question.times is not None:
        moments = np.column_stack([question.times, np.ones(len(question.times))])
        return replay.channels(question.names, steps, moments)
    if question.edges is None:
        return np.column_stack([replay.ends(steps), replay.works(steps)])
    ranges = np.zeros(len(question.names)) if question.ranges is None else question.ranges
    return replay.extremes(
        question.names, steps, question.edges, ranges, evaluated=question.evaluated
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
