"""Checks of a continuation's ranges, and of its sections."""

from jointplay.records.failure import InvalidInput, Problem
from jointplay.solver.kinds.continuation_job import ContinuationJob
from jointplay.solver.kinds.periods import Periods
from jointplay.solver.kinds.section import CrankSection
from jointplay.solver.kinds.section_checks import check_section
from jointplay.solver.kinds.studies import PlacedPoints
from jointplay.solver.kinds.values import Range
from jointplay.solver.scene.clocks import moved_in_time
from jointplay.solver.scene.periods import never_back

GIVE = (
    "Give a 'section' where a channel crosses a value, such as {'channel': 'crank.theta', 'value':"
    " 0}: an orbit is then one that comes back there."
)
LEAVE = "sections of its orbits are at crank angle 0; leave 'section' out."


def check_ranges(job: ContinuationJob) -> None:
    """Refuse (InvalidInput) ranges that are none, and formulations that have no sections."""
    low, high = sorted((job.values.start, job.values.stop))
    problems = _problems(job.values, "/values")
    if job.second is not None:
        problems += _problems(job.second.values, "/second/values")
        if job.second.parameter == job.parameter:
            sentence = f"'{job.parameter}' varies along the branch; choose another parameter."
            problems.append(Problem("/second/parameter", sentence))
    if job.at is not None and not low <= job.at <= high:
        sentence = f"'at' must lie in the range, {low:g} to {high:g}; it is {job.at:g}."
        problems.append(Problem("/at", sentence))
    if job.formulation != "reduced":
        sentence = (
            "Sections are joint coordinates, which only the formulation 'reduced' has; choose that."
            " The motion is the same, and so are orbits and multipliers, but for rounding."
        )
        problems.append(Problem("/formulation", sentence))
    if problems:
        raise InvalidInput(problems)


def _problems(values: Range, pointer: str) -> list[Problem]:
    problems = []
    if values.start == values.stop:
        problems.append(
            Problem(f"{pointer}/to", "The range is empty; 'to' must differ from 'from'.")
        )
    if values.spacing != "linear":
        sentence = "A branch chooses its own steps; leave 'spacing' out."
        problems.append(Problem(f"{pointer}/spacing", sentence))
    return problems


def check_sections(job: ContinuationJob, checked: PlacedPoints, units: Periods) -> None:
    """Refuse (InvalidInput) sections that orbits do not come back to at every point."""
    scenes = [checked.scenes.scene(point) for point in range(checked.points.count)]
    moving = next(filter(None, map(moved_in_time, scenes)), "")
    if never := next(filter(None, map(never_back, scenes)), ""):
        raise InvalidInput.at("/scene", f"{never}: there is no motion that comes back.")
    if job.section is not None and moving:
        raise InvalidInput.at("/section", f"'{moving}' moves the mechanism in time, so {LEAVE}")
    if job.section is None and units.notes and not moving:
        raise InvalidInput.at("/section", f"Nothing moves the mechanism in time. {GIVE}")
    check_section(job.section or CrankSection(), checked, units)
