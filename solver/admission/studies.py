"""From checked points to a study: sizes against the limits, chains, blocks, the filled-in job."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.failure import LimitExceeded, Problem
from jointplay.solver.admission import documents
from jointplay.solver.admission.limits import (
    BYTES_PER_POINT,
    BYTES_PER_VALUE,
    EVENT_PATIENCE,
    LONGEST_RUN,
    LONGEST_SETTLING,
    MOST_BYTES,
    MOST_PERIODS,
    MOST_POINTS,
)
from jointplay.solver.admission.methods import check_study
from jointplay.solver.admission.observables import chosen, coordinate_channels
from jointplay.solver.admission.points import Points
from jointplay.solver.admission.sections import check_section
from jointplay.solver.admission.spans import crank_offsets, periods
from jointplay.solver.admission.varied import CheckedPoints, check_points
from jointplay.solver.jobs import INDICATORS, CrankSection, MechanismJob, SectionStudyJob
from jointplay.solver.runs.study.blocks import chained_blocks, chains_of, independent_blocks
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.scene.channels import Channel

Floats = NDArray[np.float64]


def section_study(
    job: SectionStudyJob,
    points: Points,
    *,
    thorough: bool,
    continuation: str = "none",
    chains: int = 1,
) -> Study:
    """Check a study of sections and fill it in; see `solver.admission.readmit` for `thorough`.

    Raises
    ------
    InvalidInput
        With what is wrong, at its field or value.
    LimitExceeded
        The study is sound but too large; the sentence gives the estimate.
    """
    check_study(job, tangents="lyapunov" in indicators_of(job))
    checked = check_points(job, points, thorough=thorough)
    observables = chosen(checked, job.observables, coordinate_channels(checked), "/observables")
    units = periods(checked)
    check_section(job, points, checked, units, thorough=thorough)
    settle = LONGEST_SETTLING if job.settle == "auto" else job.settle
    turning = isinstance(job.section, CrankSection)
    offset = (
        crank_offsets(units, job.section.crank_angle)
        if isinstance(job.section, CrankSection)
        else np.zeros(points.count)
    )
    recording = job.record if turning else EVENT_PATIENCE * job.record
    twice = 2 if continuation == "both" else 1
    indicators = indicators_of(job)
    stored = check_limits(
        points.count * twice,
        settle + recording,
        "/settle" if isinstance(job.settle, int) and job.settle > recording else "/record",
        record=job.record,
        observables=len(observables),
    )
    filled = documents.filled(
        job,
        checked.document,
        checked.echo,
        observables=[channel.name for channel in observables],
        indicators=list(indicators),
    )
    return make_study(
        job,
        points,
        checked,
        filled,
        continuation=(continuation, chains),
        observables=observables,
        record=job.record,
        indicators=indicators,
        period=units.seconds,
        offset=offset,
        settle=settle * units.seconds,
        duration=(settle + recording) * units.seconds + offset,
        stored_bytes=stored,
    )


def indicators_of(job: SectionStudyJob) -> tuple[str, ...]:
    """Return the indicators that a job asks for, in their own order."""
    return tuple(
        name
        for name in INDICATORS
        if job.indicators == "all" or "all" in job.indicators or name in job.indicators
    )


def check_count(count: int, pointer: str) -> None:
    """Refuse more points than a study may have, before any is made.

    Raises
    ------
    LimitExceeded
        With the number.
    """
    if count > MOST_POINTS:
        raise LimitExceeded(
            [
                Problem(
                    pointer,
                    f"These are {count:.6g} points; the limit of a study is {MOST_POINTS}. Ask for"
                    " fewer, or divide them among several jobs.",
                )
            ]
        )


def check_limits(
    points: int,
    run: float,
    place: str,
    *,
    record: int = 0,
    observables: int = 0,
    channels: int = 0,
    statistics: int = 0,
) -> int:
    """Refuse what takes too long or too much space; return the bytes that it takes.

    `run` is the longest run of a point in periods, `place` where the job says so; the others count
    what a point keeps.

    Raises
    ------
    LimitExceeded
        With the estimate.
    """
    problems = []
    if not run <= LONGEST_RUN:
        problems.append(
            Problem(
                place,
                f"A point runs for up to {run:.7g} periods; the limit is {LONGEST_RUN:g}. Ask for"
                " fewer.",
            )
        )
    elif run * points > MOST_PERIODS:
        problems.append(
            Problem(
                place,
                f"{points} points of up to {run:.3g} periods are {run * points:.3g} periods; the"
                f" limit of a study is {MOST_PERIODS:g}. Ask for fewer points or periods.",
            )
        )
    numbers = record * (observables + 1) + 4 * channels + statistics
    per_point = BYTES_PER_VALUE * numbers + BYTES_PER_POINT
    stored = points * per_point
    if stored > MOST_BYTES:
        problems.append(
            Problem(
                place,
                f"{points} points with {record} sections of {observables} observables are about"
                f" {stored / 1e9:.3g} GB; the limit is {MOST_BYTES / 1e9:g} GB. Record fewer"
                " sections, or fewer observables.",
            )
        )
    if problems:
        raise LimitExceeded(problems)
    return int(stored)


def make_study(
    job: MechanismJob,
    points: Points,
    checked: CheckedPoints,
    filled: dict[str, Any],
    *,
    period: Floats,
    offset: Floats,
    settle: Floats,
    duration: Floats,
    stored_bytes: int,
    continuation: tuple[str, int] = ("none", 1),
    observables: tuple[Channel, ...] = (),
    record: int = 0,
    channels: tuple[Channel, ...] = (),
    indicators: tuple[str, ...] = (),
) -> Study:
    """Return the study of checked points; periods and times are (points,) s.

    `continuation` : the direction, and the number of chains in each.
    """
    direction, segments = continuation
    chains = chains_of(points.count, direction, segments)
    total = sum(len(chain) for chain in chains)
    chain_of = np.empty(total, np.int64)
    for index, chain in enumerate(chains):
        chain_of[list(chain)] = index
    row = np.arange(total) % points.count  # the values once more for the other direction
    declared = checked.declared.parameters
    return Study(
        kind=job.kind,
        job=filled,
        digest=documents.digest(filled),
        scene=checked.first,
        parameters=points.parameters,
        parameter_units=tuple(declared[name].unit for name in points.parameters),
        values=checked.scenes.values[row],
        observables=observables,
        record=record,
        channels=channels,
        indicators=indicators,
        blocks=(
            independent_blocks(total)
            if direction == "none"
            else chained_blocks(chains, points.count)
        ),
        chain_of=chain_of,
        chain_order=chains,
        structure=checked.structure[row],
        period=period[row],
        offset=offset[row],
        settle=settle[row],
        duration=duration[row],
        stored_bytes=stored_bytes,
        scenes=checked.scenes.at_rows(row),
    )
