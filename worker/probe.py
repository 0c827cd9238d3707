"""`python -m jointplay.worker.probe FD`: says what jobs will cost, computing the beginning of each.

Receives admitted jobs through the connection whose file descriptor is its argument, each with
whether graphics processors may compute it, and answers with dictionaries, until it is idle. A job
that is over within the budget is known exactly; of a longer one the pace at the end of the
beginning is taken for the rest.
"""

import shutil
import tempfile
import time
from contextlib import suppress
from dataclasses import asdict, dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

from jointplay.records.failure import InvalidInput, SimulationFailed
from jointplay.solver.computations import computation_of
from jointplay.solver.kernels.cache import SPENT
from jointplay.solver.kinds import Admission, Study, parse
from jointplay.solver.runs.dense_output.columns import most_steps
from jointplay.solver.runs.simulate import Simulation
from jointplay.solver.runs.study.required_study import required_study
from jointplay.solver.runs.trial_pace import trial_pace
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.object_stores.folder import Folder
from jointplay.storage.packed.reading import Packed
from jointplay.storage.results.certificate_group import CERTIFICATE
from jointplay.storage.results.intervals import GROUP as INTERVALS
from jointplay.storage.results.steps import GROUP as STEPS
from jointplay.worker.answering import answer_questions
from jointplay.worker.execute import Answer, Outcome, Progress, execute
from jointplay.worker.own_device import trial_scenes

BUDGET = 0.5
"""Seconds of computing spent on one estimate; more where nothing has moved by then."""
_LEAST_STEPS, _LONGEST = 20_000, 4.0
"""Accepted steps of a simulation that are made though they take longer than that, up to so many
seconds: the few that a busy machine makes in it do not show the pace."""
_MOST_BLOCKS = 3
"""Blocks of a study of which the beginning is computed: first, middle and last."""
_BEGINNING = 0.2
"""Part of what was computed whose pace is not taken for that of the rest: how a motion starts."""
_STUDY_COMPRESSION = 0.8  # of sections and peaks; of a simulation it is measured
_MEMORY = Path("/dev/shm")  # noqa: S108  (TemporaryDirectory makes a private folder in it)
_ROOM = 2_000_000_000  # bytes
_IDLE = 300.0  # s


@dataclass(frozen=True)
class Cost:
    """Cost of a job: `seconds` of one core, accepted `steps`, `bytes` on the disk."""

    seconds: float
    steps: int
    bytes: int
    compilation: float  # s of one core that the equations took to compile; 0: they were
    points: int  # of a study; 1
    blocks: int  # that can be computed at the same time
    exact: bool  # it was computed to its end
    failure: str | None  # why it will end early
    trial_steps: float | None
    """Steps of the mechanism by which graphics processors are tried that this processor makes in
    the same time; None: they do not compute the job, or nobody asked."""


@dataclass(frozen=True)
class Mark:
    """Progress of a probe."""

    seconds: float
    fraction: float
    steps: float
    reached: float
    """Part of the run that has the steps; companions, by which `fraction` goes, may be behind."""


def cost_of(document: dict[str, Any], *, on_devices: bool = False) -> Cost:
    """Return what an admitted job takes on this machine, at its present load.

    `on_devices` : whether `Cost.trial_steps` is wanted.

    Raises
    ------
    InvalidInput
        The job cannot be computed after all.
    """
    admitted = parse(document)
    before = SPENT.seconds
    cost = _of_study(admitted) if isinstance(admitted, Study) else _of_simulation(admitted)
    cost = replace(cost, compilation=SPENT.seconds - before)
    if on_devices and isinstance(admitted, Study):
        cost = replace(cost, trial_steps=_trial_steps(admitted, cost.seconds))
    return cost


def _of_simulation(admission: Admission) -> Cost:
    with suppress(SimulationFailed):
        next(Simulation(admission).slices(), None)  # kernels are loaded, or compiled
    outcome, marks, fixed, growing, steps_kept = _run(admission, BUDGET)
    exact = outcome.state != "cancelled"
    if exact:
        steps = int((outcome.statistics or {}).get("steps", 0))
        seconds = marks[-1].seconds
        if seconds < BUDGET / 2:  # the clock is coarse, and the first run warms the caches
            seconds = min(seconds, _run(admission, BUDGET)[1][-1].seconds)
        whole = Mark(seconds, 1.0, steps, 1.0)
    else:
        whole = _extrapolated(marks)
    share = 1.0 if exact else max(marks[-1].reached, 1e-9)
    return Cost(
        seconds=whole.seconds,
        steps=round(whole.steps),
        bytes=round(
            fixed
            + growing / share * (1.0 if exact else 1.0 + 2.0 * _without_steps(admission, whole))
            + min(steps_kept / share, admission.steps_limit)
        ),
        compilation=0.0,
        points=1,
        blocks=1,
        exact=exact,
        failure=outcome.error.detail if outcome.error else None,
        trial_steps=None,
    )


def _run(admission: Admission, budget: float) -> tuple[Outcome, list[Mark], int, int, int]:
    """Compute for `budget` seconds. Returns also bytes of documents, numbers and steps."""
    marks: list[Mark] = []
    began, duration = _worked(), float(admission.job["duration"])

    def report(progress: Progress) -> Answer:
        spent, reached = _worked() - began, progress.time / duration
        marks.append(Mark(spent, progress.fraction, progress.steps() or 0, reached))
        moved = len(marks) > 1 and progress.fraction > 0.0
        shown = marks[-1].steps >= _LEAST_STEPS or spent > _LONGEST
        return Answer.cancel if moved and shown and spent > budget else Answer.go_on

    with tempfile.TemporaryDirectory(prefix="jointplay-", dir=_scratch()) as name:
        target = StoredObject(Folder(name), "store.zip")
        outcome = execute(admission, Path(name) / "running", target, report=report)
        marks.append(Mark(_worked() - began, outcome.fraction, 0, outcome.time / duration))
        total, entries = target.size(), Packed(target).entries
    growing = steps = 0
    for key, entry in entries.items():
        if key.startswith(f"{STEPS}/"):
            steps += entry.size
        elif not key.endswith(".json") and not key.startswith(CERTIFICATE):
            part = outcome.state == "cancelled" and key.startswith(f"{INTERVALS}/")
            growing += 0 if part else entry.size
    if outcome.state == "cancelled":
        marks.pop()  # sealing a part says nothing about the rest
    return outcome, marks, total - growing - steps, growing, steps


def _worked() -> float:
    """Return the processor time of this process but for compiling, also that on the way [s]."""
    return time.process_time() - SPENT.seconds


def _without_steps(admission: Admission, whole: Mark) -> float:
    """Return the share of a run whose steps are beyond the limit: two extremes for each sample."""
    return max(1.0 - most_steps(admission) / whole.steps, 0.0) if whole.steps else 0.0


def _scratch() -> str | None:
    """Return a folder in memory, if there is room: what is stored there is thrown away."""
    try:
        return str(_MEMORY) if shutil.disk_usage(_MEMORY).free > _ROOM else None
    except OSError:
        return None


def _of_study(study: Study) -> Cost:
    count = len(study.blocks)
    chosen = sorted({0, count // 2, count - 1})[:_MOST_BLOCKS]
    seconds = steps = 0.0
    points, exact, failure = 0, True, None
    next(computation_of(study, chosen[0]).slices(), None)  # kernels are loaded, or compiled
    for index in chosen:
        marks, found = _run_block(study, index, BUDGET / len(chosen))
        failure = failure or found
        whole = _extrapolated(marks)
        exact &= marks[-1].fraction >= 1.0
        seconds, steps = seconds + whole.seconds, steps + whole.steps
        points += study.blocks[index][1]
    every = len(study.values) if not study.parameters else sum(n for _, n in study.blocks)
    return Cost(
        seconds=seconds / points * every,
        steps=round(steps / points * every),
        bytes=round(_STUDY_COMPRESSION * study.stored_bytes),
        compilation=0.0,
        points=every,
        blocks=count,
        exact=exact and len(chosen) == count,
        failure=failure,
        trial_steps=None,
    )


def _trial_steps(study: Study, seconds: float) -> float | None:
    try:
        required_study(study)
    except InvalidInput:
        return None
    return seconds * _pace()


@cache
def _pace() -> float:
    return trial_pace([*trial_scenes()])


def _run_block(study: Study, index: int, budget: float) -> tuple[list[Mark], str | None]:
    run = computation_of(study, index)
    marks, failure = [], None
    for piece in run.slices():
        for point in piece.ended:
            failure = failure or (f"Point {point.point}: {point.detail}" if point.code else None)
        marks.append(Mark(run.seconds, piece.fraction, run.steps, piece.fraction))
        first = marks[0]  # before it the starts of all points were put together: that is no pace
        if run.seconds - first.seconds > budget and piece.fraction > first.fraction:
            break
    return marks, failure


def _extrapolated(marks: list[Mark]) -> Mark:
    """Return the end of a run of which these marks show the beginning."""
    last = marks[-1]
    settled = next(mark for mark in marks if mark.fraction >= _BEGINNING * last.fraction)
    if settled.fraction >= last.fraction:
        first = marks[0]
        settled = first if first.fraction < last.fraction else Mark(0.0, 0.0, 0.0, 0.0)
    share = (1.0 - last.fraction) / max(last.fraction - settled.fraction, 1e-12)
    of_steps = (1.0 - last.reached) / max(last.reached - settled.reached, 1e-12)
    return Mark(
        last.seconds + share * (last.seconds - settled.seconds),
        1.0,
        last.steps + of_steps * (last.steps - settled.steps),
        1.0,
    )


def _answer(question: dict[str, Any]) -> dict[str, Any]:
    try:
        return asdict(cost_of(question["job"], on_devices=question["on_devices"]))
    except InvalidInput as error:
        return {"refused": str(error)}


if __name__ == "__main__":
    answer_questions(_answer, _IDLE)
