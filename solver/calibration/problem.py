"""A calibration document checked whole, before anything is computed."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from pydantic import ValidationError

from jointplay.records.channel import Channel
from jointplay.records.failure import InvalidInput, LimitExceeded, Problem
from jointplay.records.remarks import without_remarks
from jointplay.records.suggestions import unknown
from jointplay.solver.calibration.document import CalibrationJob, CalibrationTarget
from jointplay.solver.calibration.space import Space, space_of, space_problems
from jointplay.solver.calibration.targets import Goals, goals_of, target_problems
from jointplay.solver.kinds import Study, admit
from jointplay.solver.kinds.documents import digest, filled
from jointplay.solver.kinds.job import PresetScene
from jointplay.solver.kinds.limits import MOST_PERIODS
from jointplay.solver.kinds.mechanism import declared, resolve
from jointplay.solver.kinds.methods import check_study, chosen
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.sentences import schema_problems

MOST_RUNS = 10_000_000
"""Largest number of runs of a calibration: some hours."""


@dataclass(frozen=True, eq=False)
class CheckedCase:
    """A case whose scene can be simulated at every corner of the parameters' box."""

    name: str
    parameters: dict[str, float | str | None]
    targets: tuple[CalibrationTarget, ...]
    channels: tuple[Channel, ...]
    """Channel of each target."""
    study: Study
    """A sweep over the corners: it makes the scene of any candidate."""

    @property
    def duration(self) -> float:
        """When the last window ends, s."""
        return max(target.stop for target in self.targets)


@dataclass(frozen=True, eq=False)
class Calibration:
    """A calibration that can be computed."""

    document: dict[str, Any]
    """Filled in: every default and every scene parameter present."""
    digest: str
    job: CalibrationJob
    scene_document: dict[str, Any]
    """The scene as it was written, its parameters at their defaults."""
    scene: Scene
    space: Space
    cases: tuple[CheckedCase, ...]
    goals: Goals
    """Goals of all targets, case after case."""

    @property
    def tolerance(self) -> float:
        """Local error tolerance of each run."""
        return float(self.document["tolerance"])

    @property
    def seed(self) -> int:
        """Seed of the search and of the spread."""
        return self.job.search.seed


def admit_calibration(document: object) -> Calibration:
    """Check a calibration document and fill in its defaults.

    Raises
    ------
    InvalidInput
        With every problem that was found, each pointing at its field.
    LimitExceeded
        The calibration is sound but too large; the sentence gives the estimate.
    """
    job = _parse(without_remarks(document))
    check_study(job, tangents=False)
    written, scene, _ = declared(job)
    problems = [*space_problems(job.parameters, scene), *_target_problems(job)]
    problems += _twice_set(job)
    if problems:
        raise InvalidInput(problems)
    _, resolved, echo = resolve(job)
    space = space_of(job.parameters)
    cases = tuple(_check_case(job, index, space) for index in range(len(job.cases)))
    _check_size(job, cases)
    goals = goals_of([target for case in cases for target in case.targets])
    document = filled(job, resolved, echo)
    return Calibration(document, digest(document), job, written, scene, space, cases, goals)


def _parse(document: object) -> CalibrationJob:
    if not isinstance(document, Mapping):
        raise InvalidInput.at("", "A calibration is a JSON object with a kind and a scene.")
    if document.get("kind") != "calibration":
        raise InvalidInput.at("/kind", "'kind' must be 'calibration'.")
    try:
        return CalibrationJob.model_validate(dict(document))
    except ValidationError as error:
        raise InvalidInput(schema_problems(error, CalibrationJob, document)) from None


def _target_problems(job: CalibrationJob) -> list[Problem]:
    problems: list[Problem] = []
    for index, case in enumerate(job.cases):
        place = f"/cases/{index}/targets"
        for number, target in enumerate(case.targets):
            problems += target_problems(target, f"{place}/{number}")
        steps = [target.sampled for target in case.targets if target.sampled is not None]
        if len(set(steps)) > 1:
            number = next(k for k, t in enumerate(case.targets) if t.sampled == steps[-1])
            sentence = (
                f"One case is read off one grid: {steps[0]:g} s or {steps[-1]:g} s. Put the other"
                " targets into a case of their own, with the same parameters."
            )
            problems.append(Problem(f"{place}/{number}/sampled", sentence))
    if not any(target.weight for case in job.cases for target in case.targets):
        sentence = "No target has a weight, so nothing can be fitted; give one of them a weight."
        problems.append(Problem("/cases/0/targets/0/weight", sentence))
    return problems


def _twice_set(job: CalibrationJob) -> Iterable[Problem]:
    for index, case in enumerate(job.cases):
        for name in case.parameters.keys() & job.parameters.keys():
            sentence = f"'{name}' is to be found; a case cannot set it. Leave it out of one."
            yield Problem(f"/cases/{index}/parameters/{name}", sentence)


def _check_case(job: CalibrationJob, index: int, space: Space) -> CheckedCase:
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
        study = admit(sweep)
    except InvalidInput as error:
        raise type(error)(_relocated(error, job, index)) from None
    if not isinstance(study, Study):
        raise TypeError("a sweep is a study")
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
            place = f"/cases/{index}/parameters/{name}"
            raise InvalidInput.at(place, unknown("parameter", name, known))
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


def _check_size(job: CalibrationJob, cases: tuple[CheckedCase, ...]) -> None:
    candidates = job.search.population * len(job.parameters) * (job.search.generations + 1)
    runs = candidates * len(cases)
    periods = candidates * sum(
        float((case.study.duration / case.study.period).max()) for case in cases
    )
    if runs > MOST_RUNS or periods > MOST_PERIODS:
        raise LimitExceeded.at(
            "/search/generations",
            f"{candidates} candidates in {len(cases)} cases are {runs:.3g} runs of"
            f" {periods:.3g} periods; the limits are {MOST_RUNS:g} and {MOST_PERIODS:g}."
            " Ask for fewer generations, or a smaller population.",
        )


def _shown(value: float | str | None) -> str:
    return f"{value:.6g}" if isinstance(value, float | int) else str(value)
