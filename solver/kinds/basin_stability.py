"""The kind ``basin-stability``: shares of starts by the attractor that they end on."""

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from jointplay.records.failure import InvalidInput, Problem
from jointplay.solver.designs.independent import independent
from jointplay.solver.distributions import DISTRIBUTIONS, Distribution
from jointplay.solver.kinds.attractors import AttractorKind
from jointplay.solver.kinds.limits import MOST_OF_A_CHART, check_count
from jointplay.solver.kinds.map import Along
from jointplay.solver.kinds.motion_map import MotionsJob
from jointplay.solver.kinds.perturbed import seed_of
from jointplay.solver.kinds.points import Axis, Points, check_distinct
from jointplay.solver.kinds.values import axis, count
from jointplay.solver.quantities.registry import MemberOf
from jointplay.solver.quantities.units import quantity
from jointplay.solver.scene import start_numbers

Drawn = Annotated[Distribution, MemberOf(DISTRIBUTIONS, "distribution", required=True)]
Pointer = Annotated[str, Field(pattern=start_numbers.PATTERN, max_length=96)]


class BasinStabilityJob(MotionsJob):
    """Shares of drawn starts by the attractor that they end on, also over a parameter."""

    kind: Literal["basin-stability"]
    starts: Annotated[
        dict[Pointer, Drawn],
        Field(
            min_length=1,
            max_length=64,
            description=(
                "distributions of numbers of the start, or of a driver's phase, by JSON pointers"
                " into the scene; they are independent of each other"
            ),
        ),
    ]
    samples: Annotated[int, quantity("1", ge=1, le=10**12, description="starts that are drawn")] = (
        1000
    )
    seed: Annotated[int, seed_of("what is drawn")] = 0
    along: Annotated[
        Along | None,
        Field(description="a parameter: the same starts at each of its values; default: none"),
    ] = None

    @property
    def varied_starts(self) -> list[str]:
        """See `MechanismJob.varied_starts`."""
        return list(self.starts)


class BasinStability(AttractorKind[BasinStabilityJob]):
    """A point for each start that is drawn, at each value of the parameter; starts vary slowest."""

    document = BasinStabilityJob
    results: ClassVar = ("points", "attractors", "figures", "zarr")
    counted: ClassVar = "/samples"

    def points(self, job: BasinStabilityJob) -> Points:
        """Return the points; of more samples the first ones are the same."""
        own = list(_problems(job))
        if own:
            raise InvalidInput(own)
        values = 1 if job.along is None else count(job.along.values)
        check_count(job.samples * values, "/samples", MOST_OF_A_CHART)
        shares = independent(job.samples, len(job.starts), job.seed)[:, 0]
        axes = [
            Axis(
                start_numbers.name_of(start),
                _pointer(start),
                one.quantiles(column),
                lambda _at, start=start: _pointer(start),  # type: ignore[misc]
                start=start,
            )
            for (start, one), column in zip(job.starts.items(), shares.T, strict=True)
        ]
        sample, value = np.divmod(np.arange(job.samples * values, dtype=np.int64), values)
        written = np.tile(sample[:, None], (1, len(axes)))
        if job.along is not None:
            parameter = job.along.parameter
            axes.insert(0, axis(parameter, job.along.values, "/along/parameter", "/along/values"))
            check_distinct(axes[:1], "its starts would count twice")
            written = np.column_stack([value, written])
        return Points(tuple(axes), written, lambda _point: "/starts")


def _pointer(start: str) -> str:
    return "/starts/" + start.replace("/", "~1")


def _problems(job: BasinStabilityJob) -> Iterator[Problem]:
    for start, one in job.starts.items():
        for field, sentence in one.problems():
            yield Problem(f"{_pointer(start)}/{field}", sentence)
