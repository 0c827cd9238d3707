"""Limits of a job: lengths, counts and bytes."""

from jointplay.records.failure import LimitExceeded, Problem
from jointplay.solver.runs.admission import Admission
from jointplay.solver.runs.study.plan import Study

LONGEST_RUN = 1e6
"""Longest duration of one run, in periods."""
LONGEST_IDEAL_RUN = 100.0
"""The same for an ideal mechanism that never repeats: every pose follows from the one before."""
MOST_TURNS_FOLLOWED = 300.0
"""Turns of the fastest driver of an ideal mechanism in the period of all its drivers."""
MOST_FIXED_STEPS = 4e9
"""Steps of a run whose step is given, as of any run: some hours of one core."""
MOST_SAMPLES = 100_000_000
MOST_BYTES = 10_000_000_000
STEP_BYTES = 32_000_000
"""Bytes of accepted steps that a run keeps unless it is told otherwise."""
BYTES_PER_VALUE = 8.0
DEFAULT_SAMPLES = 2000

MOST_POINTS = 100_000
"""Points of a study."""
MOST_OF_A_CHART = 4_000_000
"""Points of a chart, which keeps a few numbers of each."""
MOST_GEOMETRIES = 2000
"""Geometries or structures of a study: each takes about two milliseconds to put together."""
MOST_PERIODS = 1e8
"""Periods of all points of a study together."""
MOST_NUMBERS_OF_A_MAP = 64_000_000
"""Numbers of all points of a map together: who reads one quantity has all in memory."""
MOST_PERIODS_OF_A_CHART = 4e9
"""Periods of all points of a chart together."""
LONGEST_SETTLING = 2000
"""Periods after which "settle": "auto" stops waiting."""
EVENT_PATIENCE = 20
"""Periods per section that is not taken at a crank angle, before a run ends without it."""
LONGEST_ACCURACY_STUDY = 100
"""Periods: each of some fifty runs takes that long, and references at the tightest tolerance."""
MOST_STATISTICS = 512
"""Statistics of channels and contacts a point: each is an array of its own."""
MOST_SAMPLES_OF_STATISTICS = 1e10
"""Samples of all points of a study together: some hours of looking at them."""
BYTES_PER_POINT = 512.0
"""Bytes of a study beside sections and peaks: status, statistics, indicators."""


BYTES_PER_BRIEF_POINT = 96.0
"""The same where ledgers and grounds of verdicts are not kept."""


def check_count(count: int, pointer: str, most: int = MOST_POINTS) -> None:
    """Refuse (LimitExceeded) more points than a study may have, before any is made."""
    if count > most:
        raise LimitExceeded.at(
            pointer,
            f"These are {count:.7g} points; the limit is {most}. Ask for fewer, or divide them"
            " among several jobs.",
        )


def check_size(study: Study, run: float, pointer: str, most: float = MOST_PERIODS) -> None:
    """Refuse (LimitExceeded) what takes too long or too much space.

    `run` : periods of the longest run of a point; `pointer` : where in the job that is said;
    `most` : periods that all points may take together.
    """
    points, problems = study.points, []
    if not run <= LONGEST_RUN:
        problems.append(
            f"A point runs for up to {run:.7g} periods; the limit is {LONGEST_RUN:g}. Ask for"
            " fewer."
        )
    elif run * points > most:
        problems.append(
            f"{points} points of up to {run:.3g} periods are {run * points:.3g} periods; the"
            f" limit is {most:g}. Ask for fewer points or periods."
        )
    if study.stored_bytes > MOST_BYTES:
        what, fewer = "", "points"
        if study.record:
            what = f" with {study.record} sections of {len(study.observables)} observables"
            fewer = "sections, or fewer observables"
        problems.append(
            f"{points} points{what} are about {study.stored_bytes / 1e9:.3g} GB; the limit is"
            f" {MOST_BYTES / 1e9:g} GB. Ask for fewer {fewer}."
        )
    if problems:
        raise LimitExceeded(Problem(pointer, sentence) for sentence in problems)


def check_numbers(points: int, each: int, pointer: str) -> None:
    """Refuse (LimitExceeded) a map whose points have too many numbers to be read at once."""
    if points * each > MOST_NUMBERS_OF_A_MAP:
        raise LimitExceeded.at(
            pointer,
            f"{points} points with {each} numbers each are more than {MOST_NUMBERS_OF_A_MAP};"
            f" {MOST_NUMBERS_OF_A_MAP // each} such points fit. Ask for fewer points, or for fewer"
            " channels and statistics.",
        )


def check_room(admitted: Admission | Study, most: float) -> None:
    """Refuse (LimitExceeded) results that might have more than `most` bytes, before compression."""
    kept = admitted.steps_limit if isinstance(admitted, Admission) else 0
    total = admitted.stored_bytes + kept
    if total <= most:
        return
    if isinstance(admitted, Study):
        pointer, remedy = "/record" if admitted.record else "", "Record less, or at fewer points."
    elif kept > admitted.stored_bytes:
        pointer, remedy = "/steps_limit", "Keep fewer bytes of steps."
    elif admitted.samples >= admitted.sections:
        pointer, remedy = "/output_step", "Choose a larger output_step, or fewer channels."
    else:
        pointer, remedy = "/duration", "Choose a shorter duration, or fewer channels."
    raise LimitExceeded.at(
        pointer,
        f"The results may have {total / 1e9:.3g} GB before compression; the object store of this"
        f" service takes {most / 1e9:g} GB. {remedy}",
    )
