"""Admission of the kind ``simulate``: one trajectory."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from jointplay.records.failure import LimitExceeded, Problem
from jointplay.solver.admission import documents
from jointplay.solver.admission.limits import (
    BYTES_PER_VALUE,
    DEFAULT_SAMPLES,
    LONGEST_IDEAL_RUN,
    LONGEST_RUN,
    MOST_BYTES,
    MOST_SAMPLES,
)
from jointplay.solver.admission.mechanism import check, offered, resolve
from jointplay.solver.admission.methods import chosen
from jointplay.solver.integrators import method_for
from jointplay.solver.jobs import ACCURACIES, SimulateJob
from jointplay.solver.kernels.record.length import check_length
from jointplay.solver.mechanics.assembly import shortest_link
from jointplay.solver.scene.channels import Channel, select
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.periods import (
    Period,
    characteristic_time,
    common_period,
    section_offset,
)


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
        """Local error tolerance; where the step is fixed, the standard one as a scale."""
        return float(self.job["tolerance"] or ACCURACIES["standard"][1])

    @property
    def method(self) -> str:
        """Name of the integration method, of `solver.integrators.METHODS`."""
        return method_for(self.job["method"], self.job["tolerance"])


def admit_simulate(job: SimulateJob) -> Admission:
    """Check a parsed job and fill in its defaults.

    Raises
    ------
    InvalidInput
        With every problem that was found, each pointing at its field.
    LimitExceeded
        The job is sound but too large; the sentence gives the estimate.
    """
    scene, scene_document, echo = resolve(job)
    tree, assembly = check(scene)
    if assembly.freedom_with_play:
        check_length(scene, tree, job.formulation)
    selected = select(offered(scene), list(job.channels), "/channels")
    period = common_period(scene)
    longest = LONGEST_RUN
    if period.seconds is None and assembly.freedom_with_play == 0:
        longest = LONGEST_IDEAL_RUN
    chosen(job)
    output_step = job.output_step or job.duration / DEFAULT_SAMPLES
    samples = sample_count(job.duration, output_step)
    sections = section_count(scene, period, job)
    stored = int(BYTES_PER_VALUE * (len(selected) + 1) * (samples + sections))
    _limits(scene, job, period, longest, samples, sections, output_step, len(selected))
    filled = documents.filled(
        job,
        scene_document,
        echo,
        output_step=output_step,
        channels=[channel.name for channel in selected],
    )
    return Admission(
        job=filled,
        scene=scene_document,
        digest=documents.digest(filled),
        channels=selected,
        samples=samples,
        sections=sections,
        period=period.seconds,
        section_note=period.note,
        joints=tree.play,
        stored_bytes=stored,
    )


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
