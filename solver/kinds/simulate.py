"""The kind ``simulate``: one trajectory, from the scene's start or a state."""

import math
from collections.abc import Iterator
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field

from jointplay.records.channel import Channel
from jointplay.records.failure import InvalidInput, LimitExceeded, Problem
from jointplay.solver.kinds import documents, limits
from jointplay.solver.kinds.job import ChannelChoice, Job
from jointplay.solver.kinds.kind import Kind
from jointplay.solver.kinds.mechanism import check, resolve, written
from jointplay.solver.kinds.methods import chosen
from jointplay.solver.kinds.periods import check_period
from jointplay.solver.kinds.section import CrankSection
from jointplay.solver.kinds.start_state import StartState, check_state
from jointplay.solver.mechanics.assembly import assemble, shortest_link
from jointplay.solver.quantities.units import quantity
from jointplay.solver.runs.admission import STANDARD_TOLERANCE, Admission
from jointplay.solver.scene.channels import channels, select
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.domains import domain_problems
from jointplay.solver.scene.least_common_period import Period
from jointplay.solver.scene.pairs import contact_pairs
from jointplay.solver.scene.parameters import set_parameters
from jointplay.solver.scene.periods import common_period, drivers_period, section_offset
from jointplay.solver.scene.time_scales import characteristic_time, quickest_driver

WITHOUT_PERIOD = (
    "Without one a simulation has no Poincare section; a study has them where a channel crosses a"
    " value, or at onsets of contact."
)


class SimulateJob(Job):
    """One trajectory, from the scene's start or a state."""

    kind: Literal["simulate"]
    duration: Annotated[float, quantity("s", ge=1e-9, le=1e12, description="simulated time")]
    output_step: Annotated[
        float | None,
        quantity(
            "s",
            ge=1e-15,
            description=(
                "time between samples; default duration/2000; longer than the run: its two ends"
            ),
        ),
    ] = None
    settle: Annotated[
        float,
        quantity(
            "s",
            ge=0.0,
            le=1e12,
            description="what comes before does not count in peaks; changes nothing else",
        ),
    ] = 0.0
    channels: Annotated[
        ChannelChoice, Field(description="channels to store, names or globs such as 'slider7.*'")
    ] = ["*"]
    state: StartState = None
    section: Annotated[
        CrankSection,
        Field(
            description=(
                "Poincare sections are taken when the first driver has turned by that crank angle"
                " since the start; a 'motion' counts as an even turn in each period of its function"
            )
        ),
    ] = CrankSection()
    certificate: Annotated[
        bool,
        Field(description="say how far the result can be believed; does not change its bits"),
    ] = True

    steps_limit: Annotated[
        int,
        quantity(
            "B",
            ge=0,
            le=limits.MOST_BYTES,
            description=(
                "most bytes of accepted steps to keep, before compression: from them every window"
                " is read exactly; beyond, smallest and largest values from sample to sample are"
                " kept; 0: these only"
            ),
        ),
    ] = limits.STEP_BYTES

    @property
    def named_channels(self) -> list[str]:
        """See `MechanismJob.named_channels`."""
        return self.channels


class Simulate(Kind[SimulateJob]):
    """One trajectory, with its peaks, sections, impacts and certificate."""

    document = SimulateJob
    results: ClassVar = (
        *("history", "peaks", "poincare", "impacts", "spectrum", "statistics", "certificate"),
        *("figures", "zarr"),
    )

    def admit(self, job: SimulateJob) -> Admission:
        """Check and fill in; see `Kind.admit`."""
        if job.settle >= job.duration:
            sentence = (
                f"Settling for {job.settle:g} s leaves nothing of {job.duration:g} s to look at;"
                " it must be shorter."
            )
            raise InvalidInput.at("/settle", sentence)
        scene, scene_document, echo = resolve(job)
        _, assembly = check(scene, job.formulation)
        check_period(written(job)[1], [scene])
        period = common_period(scene)
        if job.section.crank_angle and period.seconds is None:
            sentence = f"{period.note} Sections need one; leave this out, or give a 'period'."
            raise InvalidInput.at("/section/crank_angle", sentence)
        outside = list(domain_problems(scene, job.duration))
        if outside:
            raise InvalidInput(outside)
        moves = assembly.freedom_with_play > 0
        if job.state is not None and not moves:
            raise InvalidInput.at("/state", "Drivers alone move this mechanism; leave 'state' out.")
        check_state(job.state, scene, job.formulation)
        selected = select(channels(scene), list(job.channels), "/channels")
        chosen(job)
        filled = documents.filled(
            job,
            scene_document,
            echo,
            output_step=job.output_step or job.duration / limits.DEFAULT_SAMPLES,
            channels=[channel.name for channel in selected],
        )
        admission = _admission(job, filled, scene, selected)
        repeats = drivers_period(scene).seconds is not None and not scene.gears
        _check_limits(admission, job.duration, endless=moves or repeats)
        if repeats and not moves:
            _check_followed(scene, job.duration)
        return admission

    def plan(self, job: SimulateJob, filled: dict[str, Any]) -> Admission:
        """Return what `admit` returned; see `Kind.plan`."""
        scene = Scene.model_validate(set_parameters(*written(job))[0])
        known = {channel.name: channel for channel in channels(scene)}
        return _admission(job, filled, scene, tuple(known[name] for name in filled["channels"]))


def _admission(
    job: SimulateJob, filled: dict[str, Any], scene: Scene, channels: tuple[Channel, ...]
) -> Admission:
    period = common_period(scene)
    samples = sample_count(job.duration, filled["output_step"])
    sections = section_count(scene, period, job)
    return Admission(
        job=filled,
        scene=scene,
        digest=documents.digest(_told_apart(filled)),
        channels=channels,
        samples=samples,
        sections=sections,
        period=period.seconds,
        section_note=f"{period.note} {WITHOUT_PERIOD}" if period.note else "",
        notes=tuple(_notes(filled, scene)),
        joints=tuple(contact_pairs(scene)),
        stored_bytes=int(limits.BYTES_PER_VALUE * (len(channels) + 1) * (samples + sections)),
    )


def _notes(filled: dict[str, Any], scene: Scene) -> Iterator[str]:
    """Yield sentences on what is given and the run does not keep."""
    assembly = assemble(scene)
    for misfit in assembly.misfits:
        yield misfit.sentence
    usual = {"method": "auto", "tolerance": STANDARD_TOLERANCE, "step": None}
    chosen_otherwise = any(filled.get(name, one) != one for name, one in usual.items())
    if chosen_otherwise and not assembly.freedom_with_play:
        yield (
            "Drivers alone move this mechanism, and its motion is computed without steps in time:"
            " method, tolerance and step have no effect."
        )


def _told_apart(filled: dict[str, Any]) -> dict[str, Any]:
    """Return what tells a job from others: fields that came later count where they are given."""
    later = ("settle", "state")
    return {name: value for name, value in filled.items() if name not in later or value}


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
    whole = (job.duration - first) / period.seconds
    return math.floor(whole + 1e-12 * max(1.0, whole)) + 1


def _check_followed(scene: Scene, duration: float) -> None:
    """Refuse an ideal mechanism whose drivers take too many turns until they come round."""
    turn = quickest_driver(scene, shortest_link(scene))
    followed = min(duration, drivers_period(scene).seconds or duration)
    if followed > limits.MOST_TURNS_FOLLOWED * turn:
        sentence = (
            f"The fastest driver turns {followed / turn:.6g} times until all come round, and each"
            f" pose follows from the one before; the limit is {limits.MOST_TURNS_FOLLOWED:g} times"
            f" ({limits.MOST_TURNS_FOLLOWED * turn:.3g} s)."
        )
        raise LimitExceeded.at("/duration", sentence)


def _check_limits(admission: Admission, duration: float, *, endless: bool) -> None:
    """Refuse what is too long or too large.

    `endless` : whether the end of a run need not be reached pose by pose.
    """
    scene, channels = admission.scene, len(admission.channels)
    longest = limits.LONGEST_RUN if endless else limits.LONGEST_IDEAL_RUN
    unit = admission.period or characteristic_time(scene, shortest_link(scene))
    problems = []
    if duration > longest * unit:
        problems.append(
            Problem(
                "/duration",
                f"{duration:g} s are {duration / unit:.3g} periods of {unit:.3g} s; the"
                f" limit is {longest:g} periods ({longest * unit:.3g} s).",
            )
        )
    if (fixed := admission.job["step"]) and duration > limits.MOST_FIXED_STEPS * fixed:
        sentence = (
            f"{duration:g} s are {duration / fixed:.3g} steps of {fixed:g} s; the limit is"
            f" {limits.MOST_FIXED_STEPS:g} steps ({limits.MOST_FIXED_STEPS * fixed:.3g} s)."
        )
        problems.append(Problem("/step", sentence))
    step = f"a larger output_step than {admission.job['output_step']:g} s"
    for pointer, what, count, remedy in (
        ("/output_step", "samples", admission.samples, step),
        ("/duration", "Poincare sections", admission.sections, "a shorter duration"),
    ):
        stored = limits.BYTES_PER_VALUE * (channels + 1) * count
        if count > limits.MOST_SAMPLES or stored > limits.MOST_BYTES:
            sentence = (
                f"{count:.3g} {what} of {channels} channels are about {stored / 1e9:.3g} GB;"
                f" the limits are {limits.MOST_SAMPLES:g} and {limits.MOST_BYTES / 1e9:g} GB."
                f" Choose {remedy}, or fewer channels."
            )
            problems.append(Problem(pointer, sentence))
    if problems:
        raise LimitExceeded(problems)
