"""From points to a study: chains, blocks, and what is said of each point."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.channel import Channel
from jointplay.solver.kinds import documents
from jointplay.solver.kinds.limits import stored_bytes
from jointplay.solver.kinds.placed_points import PlacedPoints
from jointplay.solver.runs.starts import Perturbation
from jointplay.solver.runs.study.blocks import chained_blocks, chains_of, independent_blocks
from jointplay.solver.runs.study.plan import Study

Floats = NDArray[np.float64]


def make_study(
    filled: dict[str, Any],
    placed: PlacedPoints,
    *,
    period: Floats,
    offset: Floats,
    settle: Floats,
    duration: Floats,
    continuation: tuple[str, int] = ("none", 1),
    observables: tuple[Channel, ...] = (),
    record: int = 0,
    channels: tuple[Channel, ...] = (),
    statistics: int = 0,
    indicators: tuple[str, ...] = (),
    perturbation: Perturbation | None = None,
) -> Study:
    """Return the study of a filled-in job.

    Parameters
    ----------
    filled
        The job's document.
    period, offset, settle, duration : (points,)
        s; see `Study`.
    continuation
        The direction, and the number of chains in each.
    statistics
        Numbers a point beside sections and extremes.
    """
    direction, segments = continuation
    points = placed.points
    chains = chains_of(points.count, direction, segments)
    total = sum(len(chain) for chain in chains)
    chain_of = np.empty(total, np.int64)
    for index, chain in enumerate(chains):
        chain_of[list(chain)] = index
    row = np.arange(total) % points.count  # the values once more for the other direction
    declared = placed.declared.parameters
    return Study(
        kind=filled["kind"],
        job=filled,
        digest=documents.digest(filled),
        parameters=points.parameters,
        parameter_units=tuple(declared[name].unit for name in points.parameters),
        observables=observables,
        record=record,
        channels=channels,
        indicators=indicators,
        perturbation=perturbation,
        blocks=(
            independent_blocks(total)
            if direction == "none"
            else chained_blocks(chains, points.count)
        ),
        chain_of=chain_of,
        chain_order=chains,
        structure=placed.structure[row],
        period=period[row],
        offset=offset[row],
        settle=settle[row],
        duration=duration[row],
        stored_bytes=stored_bytes(total, record, len(observables), len(channels), statistics),
        scenes=placed.scenes.at_rows(row),
    )
