"""Checks of a calibration's targets, cases and size; each case is checked as a sweep."""

from collections.abc import Iterable
from typing import Any

from jointplay.records.failure import InvalidInput, LimitExceeded, Problem
from jointplay.records.suggestions import unknown
from jointplay.solver.calibration.document import CHAINS
from jointplay.solver.calibration.length import most_candidates, most_runs
from jointplay.solver.calibration.problem import CheckedCase
from jointplay.solver.calibration.space import Space
from jointplay.solver.calibration.targets import target_problems
from jointplay.solver.kinds.calibration_job import CalibrationJob
from jointplay.solver.kinds.documents import job_of
from jointplay.solver.kinds.job import PresetScene
from jointplay.solver.kinds.limits import MOST_GEOMETRIES, MOST_PERIODS
from jointplay.solver.kinds.methods import chosen
from jointplay.solver.kinds.sweep import Sweep

MOST_RUNS = 10_000_000
"""Largest number of runs of a calibration: some hours."""
SWEEP = Sweep()


def target_and_case_problems(job: CalibrationJob) -> list[Problem]:
    """Return what is wrong with targets and cases, whatever the scene."""
    problems: list[Problem] = []
    for index, case in enumerate(job.cases):
        pointer = f"/cases/{index}/targets"
        for number, target in enumerate(case.targets):
            problems += target_problems(target, f"{pointer}/{number}")
        steps = [target.sampled for target in case.targets if target.sampled is not None]
        if len(set(steps)) > 1:
            number = next(k for k, t in enumerate(case.targets) if t.sampled == steps[-1])
            sentence = (
                f"One case is read off one grid: {steps[0]:g} s or {steps[-1]:g} s. Put the other"
                " targets into a case of their own, with the same parameters."
            )
            problems.append(Problem(f"{pointer}/{number}/sampled", sentence))
    if not any(target.weight for case in job.cases for target in case.targets):
        sentence = "No target has a weight, so nothing can be fitted; give one of them a weight."
        problems.append(Problem("/cases/0/targets/0/weight", sentence))
    problems += _twice_set(job)
    return problems


def _twice_set(job: CalibrationJob) -> Iterable[Problem]:
    for index, case in enumerate(job.cases):
        for name in (name for name in case.parameters if name in job.parameters):
            sentence = f"'{name}' is to be found; a case cannot set it. Leave it out of one."
            yield Problem(f"/cases/{index}/parameters/{name}", sentence)


def check_case(job: CalibrationJob, index: int, space: Space) -> CheckedCase:
    """Check a case as a sweep over the corners of the box, and its targets' channels."""
    case = job.cases[index]
    corners = space.corners()
    method, tolerance = chosen(job)
    sweep: dict[str, Any] = {
        "kind": "sweep",
        "scene": _scene_of(job, index),
        "points": corners,
        "duration": max(target.stop for target in case.targets),
        "formulation": job.formulation,
        "method": method,
        "tolerance": tolerance,
        "channels": ["*"],
    }
    try:
        study = SWEEP.admit(job_of(sweep, SWEEP))
    except InvalidInput as error:
        raise type(error)(_relocated(error, job, index)) from None
    by_name = {channel.name: channel for channel in study.channels}
    missing = [
        Problem(
            f"/cases/{index}/targets/{number}/channel",
            unknown("channel", target.channel, by_name),
        )
        for number, target in enumerate(case.targets)
        if target.channel not in by_name
    ]
    if missing:
        raise InvalidInput(missing)
    channels = tuple(by_name[target.channel] for target in case.targets)
    parameters = dict(case.parameters)
    name = case.name or ", ".join(f"{key} = {_shown(at)}" for key, at in parameters.items())
    return CheckedCase(name or f"case {index}", parameters, tuple(case.targets), channels, study)


def _scene_of(job: CalibrationJob, index: int) -> dict[str, Any]:
    """Return the scene of a case as a job takes it; of a whole scene defaults are the values."""
    case = job.cases[index]
    if isinstance(job.scene, PresetScene):
        parameters = {**job.scene.parameters, **case.parameters}
        return {"preset": job.scene.preset, "parameters": parameters}
    document = job.scene.model_dump(mode="json")
    known = document["parameters"]
    for name, value in case.parameters.items():
        if name not in known:
            pointer = f"/cases/{index}/parameters/{name}"
            raise InvalidInput.at(pointer, unknown("parameter", name, known))
        known[name]["default"] = value
    return document


def _relocated(error: InvalidInput, job: CalibrationJob, index: int) -> list[Problem]:
    """Point into the calibration instead of into the sweep that checked one of its cases."""
    found = []
    for pointer, detail in error.problems:
        parts = pointer.strip("/").split("/")
        if parts[0] == "points":
            named = parts[2] if len(parts) > 2 else ""
            pointer = f"/parameters/{named}" if named in job.parameters else "/parameters"
        elif parts[0] == "duration":
            pointer = f"/cases/{index}/targets"
        elif parts[:2] == ["scene", "parameters"] and len(parts) > 2:
            name = parts[2]
            if name in job.cases[index].parameters:
                pointer = f"/cases/{index}/parameters/{name}"
            elif name in job.parameters:
                pointer = f"/parameters/{name}"
        found.append(Problem(pointer, detail))
    return found


def check_corners(job: CalibrationJob) -> None:
    """Refuse (LimitExceeded) more corners of the parameters' box than can be put together."""
    corners = len(job.cases) * 2 ** len(job.parameters)
    if corners > MOST_GEOMETRIES:
        raise LimitExceeded.at(
            "/cases",
            f"{len(job.cases)} cases at every corner of {len(job.parameters)} parameters are"
            f" {corners} scenes, each of which is put together when the job is checked; the limit"
            f" is {MOST_GEOMETRIES}. Give fewer cases, or move fewer parameters.",
        )


def check_size(job: CalibrationJob, cases: tuple[CheckedCase, ...]) -> None:
    """Refuse (LimitExceeded) more runs than a calibration may have, or longer ones."""
    candidates = most_candidates(job.search, job.spread, len(job.parameters))
    runs = most_runs(candidates, [case.targets for case in cases])
    lengths = [float((case.study.duration / case.study.period).max()) for case in cases]
    periods = sum(count * length for count, length in zip(runs, lengths, strict=True))
    if sum(runs) > MOST_RUNS or periods > MOST_PERIODS:
        spread = CHAINS * job.spread.generations
        part = "spread" if 2 * spread > candidates else "search"
        raise LimitExceeded.at(
            f"/{part}/generations",
            f"{candidates} candidates, {spread} of them of the spread, in {len(cases)} cases are"
            f" {sum(runs):.3g} runs of {periods:.3g} periods; the limits are {MOST_RUNS:g} and"
            f" {MOST_PERIODS:g}. Ask for fewer generations, or a smaller population.",
        )


def _shown(value: float | str | None) -> str:
    return f"{value:.6g}" if isinstance(value, float | int) else str(value)
