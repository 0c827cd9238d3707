"""Admission: a job document is checked whole and filled in before anything is queued."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from pydantic import ValidationError

from solver import presets
from solver.assembly import ASSEMBLED, Assembly, assemble, shortest_link
from solver.channels import Channel, channels, select
from solver.compiler.length import check_length
from solver.drive import Period, characteristic_time, common_period
from solver.errors import InvalidInput, LimitExceeded, Problem
from solver.job import TOLERANCES, PresetScene, SimulateJob
from solver.mechanics.tree import Tree, spanning_tree
from solver.scene.document import Scene
from solver.scene.parameters import parameter_of, set_parameters
from solver.scene.references import reference_problems
from solver.scene.sentences import schema_problems

LONGEST_RUN = 1e6
"""Longest duration, in periods."""
LONGEST_IDEAL_RUN = 100.0
"""The same for an ideal mechanism that never repeats: every pose follows from the one before."""
MOST_SAMPLES = 100_000_000
MOST_BYTES = 10_000_000_000
BYTES_PER_VALUE = 8.0
DEFAULT_SAMPLES = 2000


@dataclass(frozen=True)
class Admission:
    """A job that can run: filled in, with what it will produce."""

    job: dict[str, Any]
    """The job document with every default and every scene parameter present."""
    scene: dict[str, Any]
    """The scene document with the parameters set."""
    digest: str
    """SHA-256 of the filled-in job without its label."""
    channels: tuple[Channel, ...]
    """The selected channels, in the order of the scene."""
    samples: int
    """Length of the history: k * output_step from 0, and the duration last."""
    sections: int
    """Number of Poincare sections; 0 without a period."""
    period: float | None
    """Least common period of the drivers, s."""
    section_note: str
    """Why there is no section, else empty."""
    joints: tuple[str, ...]
    """Joints with clearance, in the order of the impacts' joint index."""
    stored_bytes: int
    """Estimate of what the results take, before compression."""

    @property
    def tolerance(self) -> float:
        """Local error tolerance."""
        return float(self.job["tolerance"])


def admit(document: object) -> Admission:
    """Check a job document and fill in its defaults.

    Parameters
    ----------
    document
        What a client sent, parsed from JSON.

    Raises
    ------
    InvalidInput
        With every problem that was found, each pointing at its field.
    LimitExceeded
        The job is sound but too large; the sentence gives the estimate.
    """
    job = _parse(document)
    scene, scene_document, echo = resolve(job)
    tree, assembly = check(scene)
    if assembly.freedom_with_play:
        check_length(scene, tree, job.formulation)
    offered = _offered(scene)
    selected = select(offered, list(job.channels), "/channels")
    period = common_period(scene)
    longest = LONGEST_RUN
    if period.seconds is None and assembly.freedom_with_play == 0:
        longest = LONGEST_IDEAL_RUN
    tolerance = _tolerance(job)
    output_step = job.output_step or job.duration / DEFAULT_SAMPLES
    samples = sample_count(job.duration, output_step)
    sections = section_count(scene, period, job)
    stored = int(BYTES_PER_VALUE * (len(selected) + 1) * (samples + sections))
    _limits(scene, job, period, longest, samples, sections, output_step, len(selected))

    filled = job.model_dump(mode="json", exclude={"scene", "accuracy"})
    if isinstance(job.scene, PresetScene):
        filled["scene"] = {"preset": job.scene.preset, "parameters": echo}
    else:
        filled["scene"] = scene_document
    filled["tolerance"] = tolerance
    filled["output_step"] = output_step
    filled["channels"] = [channel.name for channel in selected]
    unlabelled = {key: value for key, value in filled.items() if key != "label"}
    spec = {"job": unlabelled, "scene": scene_document}
    canonical = json.dumps(spec, sort_keys=True, separators=(",", ":"), allow_nan=False)
    return Admission(
        job=filled,
        scene=scene_document,
        digest=hashlib.sha256(canonical.encode()).hexdigest(),
        channels=selected,
        samples=samples,
        sections=sections,
        period=period.seconds,
        section_note=period.note,
        joints=tree.play,
        stored_bytes=stored,
    )


def resolve(
    job: SimulateJob,
) -> tuple[Scene, dict[str, Any], dict[str, float | str | None]]:
    """Return a job's scene with parameters set, its document, and every parameter's value.

    Raises
    ------
    InvalidInput
        Unknown preset or parameter, values that do not fit the scene.
    """
    if isinstance(job.scene, PresetScene):
        document, values = presets.document(job.scene.preset), job.scene.parameters
        declared = Scene.model_validate(document)
    else:
        document, values = job.scene.model_dump(mode="json"), {}
        declared = job.scene
        problems = list(reference_problems(declared))
        if problems:
            raise InvalidInput(Problem(f"/scene{p.pointer}", p.detail) for p in problems)
    filled, echo = set_parameters(document, declared, values)
    try:
        scene = Scene.model_validate(filled)
    except ValidationError as error:
        raise InvalidInput(_located(schema_problems(error, Scene), declared, echo)) from None
    problems = list(reference_problems(scene))
    if problems:
        raise InvalidInput(_located(problems, declared, echo))
    return scene, filled, echo


def check(scene: Scene) -> tuple[Tree, Assembly]:
    """Return a scene's spanning tree and assembly once it can be simulated.

    Raises
    ------
    InvalidInput
        Redundant constraints, an assembly that cannot close, loops that stay closed.
    """
    tree, assembly = spanning_tree(scene), assemble(scene)
    coordinates = 3 * len(scene.bodies)
    if assembly.constraints > coordinates:
        raise InvalidInput(
            [
                Problem(
                    "/scene/joints",
                    f"The mechanism is over-constrained: {assembly.constraints} constraint"
                    f" equations hold {coordinates} coordinates; remove a joint or a driver.",
                )
            ]
        )
    residual = assembly.residual / shortest_link(scene)
    if not residual <= ASSEMBLED:
        raise InvalidInput(
            [
                Problem(
                    "/scene/start/angles",
                    f"The mechanism does not close: {assembly.residual:.3g} (m or rad) remain after"
                    " Newton's iteration. Check lengths and driver positions, or give start angles"
                    " nearer to the assembly you mean.",
                )
            ]
        )
    held = {branch.parent for branch in tree.branches} | {
        body
        for name in tree.play
        for body in (_body(scene.joints[name].bearing), _body(scene.joints[name].journal))  # type: ignore[union-attr]
    }
    adrift = [b.body for b in tree.branches if b.kind == "free" and b.body not in held]
    if adrift:
        raise InvalidInput(
            [
                Problem(
                    f"/scene/bodies/{body}",
                    f"No joint holds body '{body}'; join it or drop it.",
                )
                for body in adrift
            ]
        )
    if assembly.redundant_with_play or assembly.redundant:
        count = max(assembly.redundant, assembly.redundant_with_play)
        raise InvalidInput(
            [
                Problem(
                    "/scene/joints",
                    f"The mechanism is over-constrained: {count} of {assembly.constraints}"
                    " constraint equations are redundant; remove a joint or driver, or give one"
                    " joint clearance.",
                )
            ]
        )
    if tree.closing and assembly.freedom_with_play:
        raise InvalidInput(
            [
                Problem(
                    "/scene/joints",
                    f"Ideal joints close a loop (at {', '.join(tree.closing)}) that can still move;"
                    " such scenes are not supported yet. Give a joint of each loop a positive"
                    " clearance, or drive the mechanism fully with every clearance zero.",
                )
            ]
        )
    return tree, assembly


def sample_count(duration: float, output_step: float) -> int:
    """Return how many samples k * output_step from 0 there are before the duration, and it."""
    whole = math.floor(duration / output_step * (1.0 - 1e-12))
    if whole > 0 and duration - whole * output_step <= 1e-9 * output_step:
        whole -= 1
    elif duration - whole * output_step > output_step * (1.0 + 1e-9):
        whole += 1
    return whole + 2


def section_count(scene: Scene, period: Period, job: SimulateJob) -> int:
    """Return the number of sections at or before the duration, the start included."""
    if period.seconds is None:
        return 0
    first = section_offset(scene, period.seconds, job.section.crank_angle)
    if first > job.duration:
        return 0
    return math.floor((job.duration - first) / period.seconds * (1.0 + 1e-12)) + 1


def section_offset(scene: Scene, period: float, crank_angle: float) -> float:
    """Return the time of the first section, s: when the first driver has turned that far."""
    speeds = [abs(driver.speed) for driver in scene.drivers.values() if driver.speed != 0.0]
    return min(crank_angle / speeds[0], period) if crank_angle else 0.0


def _parse(document: object) -> SimulateJob:
    if not isinstance(document, Mapping):
        raise InvalidInput([Problem("", "A job is a JSON object with kind, scene and duration.")])
    try:
        return SimulateJob.model_validate(dict(document))
    except ValidationError as error:
        branch = "PresetScene" if _names_preset(document) else "Scene"
        raise InvalidInput(schema_problems(error, SimulateJob, branch)) from None


def _names_preset(document: object) -> bool:
    scene = document.get("scene") if isinstance(document, Mapping) else None
    return isinstance(scene, Mapping) and ("preset" in scene or "bodies" not in scene)


def _located(
    problems: Iterable[Problem], scene: Scene, echo: Mapping[str, float | str | None]
) -> list[Problem]:
    """Point at the parameter that put a value there, where there is one."""
    located = []
    for problem in problems:
        name = parameter_of(scene, echo, problem.pointer)
        pointer = f"/scene/parameters/{name}" if name else f"/scene{problem.pointer}"
        if Problem(pointer, problem.detail) not in located:
            located.append(Problem(pointer, problem.detail))
    return located


def _offered(scene: Scene) -> tuple[Channel, ...]:
    try:
        return channels(scene)
    except InvalidInput as error:
        raise InvalidInput(
            Problem(f"/scene{p.pointer}", p.detail) for p in error.problems
        ) from None


def _tolerance(job: SimulateJob) -> float:
    if job.tolerance is not None and job.accuracy is not None:
        raise InvalidInput(
            [Problem("/accuracy", "Give a tolerance or a named accuracy, not both.")]
        )
    return job.tolerance if job.tolerance is not None else TOLERANCES[job.accuracy or "standard"]


def _limits(
    scene: Scene,
    job: SimulateJob,
    period: Period,
    longest: float,
    samples: int,
    sections: int,
    output_step: float,
    channel_count: int,
) -> None:
    unit = period.seconds or characteristic_time(scene, shortest_link(scene))
    problems = []
    if job.duration > longest * unit:
        problems.append(
            Problem(
                "/duration",
                f"{job.duration:g} s are {job.duration / unit:.3g} periods of {unit:.3g} s; the"
                f" limit is {longest:g} periods ({longest * unit:.3g} s).",
            )
        )
    for pointer, what, count, remedy in (
        ("/output_step", "samples", samples, f"a larger output_step than {output_step:g} s"),
        ("/duration", "Poincare sections", sections, "a shorter duration"),
    ):
        stored = BYTES_PER_VALUE * (channel_count + 1) * count
        if count > MOST_SAMPLES or stored > MOST_BYTES:
            sentence = (
                f"{count:.3g} {what} of {channel_count} channels are about {stored / 1e9:.3g} GB;"
                f" the limits are {MOST_SAMPLES:g} and {MOST_BYTES / 1e9:g} GB. Choose {remedy},"
                " or fewer channels."
            )
            problems.append(Problem(pointer, sentence))
    if problems:
        raise LimitExceeded(problems)


def _body(reference: str) -> str:
    return reference.split(".")[0]
