"""The kind ``sensitivity``: extremes and statistics at points that are drawn by a design."""

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from jointplay.records.arrays import Flags, Floats
from jointplay.records.failure import InvalidInput, LimitExceeded, Problem
from jointplay.records.sensitivity import DESIGNS as READ
from jointplay.solver.designs import DESIGNS
from jointplay.solver.distributions import DISTRIBUTIONS, Distribution
from jointplay.solver.kinds.extremes_study import ExtremesStudy, ExtremesStudyJob
from jointplay.solver.kinds.limits import MOST_POINTS
from jointplay.solver.kinds.mechanism import declared
from jointplay.solver.kinds.perturbed import seed_of
from jointplay.solver.kinds.points import Axis, Points
from jointplay.solver.quantities.registry import MemberOf, NameIn
from jointplay.solver.quantities.units import Name, quantity
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.scene.document import Parameter
from jointplay.solver.scene.parameters import allowed_range

Drawn = Annotated[Distribution, MemberOf(DISTRIBUTIONS, "distribution", required=True)]
OF_A_SEQUENCE = "saltelli"
"""The design whose rows are those of a sequence that is even at powers of two only."""


class SensitivityJob(ExtremesStudyJob):
    """Shares that each of some parameters has in the scatter of extremes and statistics."""

    kind: Literal["sensitivity"]
    parameters: Annotated[
        dict[Name, Drawn],
        Field(
            min_length=1,
            max_length=64,
            description="distributions by parameter, which are independent of each other",
        ),
    ]
    design: Annotated[
        str,
        NameIn(DESIGNS),
        Field(
            description=(
                "saltelli: first-order and total indices, 2 + parameters points a row; morris:"
                " elementary effects, 1 + parameters points; latin-hypercube: quantiles and"
                " correlations, 1 point"
            )
        ),
    ] = OF_A_SEQUENCE
    samples: Annotated[
        int,
        quantity("1", ge=4, le=10**12, description="rows of the design; saltelli: a power of two"),
    ] = 256
    seed: Annotated[int, seed_of("the design")] = 0


class SensitivityKind(ExtremesStudy[SensitivityJob]):
    """The points of a design, row after row: whoever reads it can do so while it grows."""

    document = SensitivityJob
    results: ClassVar = ("points", "sensitivity", "figures", "zarr")
    loads_much: ClassVar = True  # scipy's sequences

    def admit(self, job: SensitivityJob) -> Study:
        """Check and fill in; see `Kind.admit`."""
        _check_rows(job)
        own = [
            Problem(f"/parameters/{name}/{field}", sentence)
            for name, one in job.parameters.items()
            for field, sentence in one.problems()
        ]
        if own:
            raise InvalidInput(own)
        known = declared(job)[1].parameters
        outside = [
            problem
            for name, one in job.parameters.items()
            if name in known and known[name].choices is None
            for problem in _outside(name, one, known[name])
        ]
        if outside:
            raise InvalidInput(outside)
        self._check_draws(job, known)
        return super().admit(job)

    def points(self, job: SensitivityJob) -> Points:
        """Return the points of the design."""
        values = _values(job)
        return Points(
            tuple(
                Axis(name, pointer, column, lambda _at, pointer=pointer: pointer)  # type: ignore[misc]
                for (name, pointer), column in zip(_pointers(job), values.T, strict=True)
            ),
            np.tile(np.arange(len(values), dtype=np.int64)[:, None], (1, len(job.parameters))),
            lambda _point: "/parameters",
        )

    def _check_draws(self, job: SensitivityJob, known: dict[str, Parameter]) -> None:
        """Refuse distributions without bounds of which draws lie outside of what is allowed."""
        problems = []
        for (name, pointer), column in zip(_pointers(job), _values(job).T, strict=True):
            parameter = known.get(name)
            if parameter is None or parameter.choices is not None:
                continue
            wrong = _beyond(column, parameter)
            if wrong.any():
                problems.append(
                    Problem(
                        pointer,
                        f"{int(wrong.sum())} of {len(column)} values are outside, such as"
                        f" {column[wrong][0]:.6g}: '{name}' {allowed_range(parameter)}. Let it be a"
                        " truncated-normal, or narrower.",
                    )
                )
        if problems:
            raise InvalidInput(problems)


def _pointers(job: SensitivityJob) -> list[tuple[str, str]]:
    return [(name, f"/parameters/{name}") for name in job.parameters]


def _values(job: SensitivityJob) -> Floats:
    """Return (points, parameters)."""
    shares = DESIGNS[job.design](job.samples, len(job.parameters), job.seed)
    columns = [
        one.quantiles(shares[..., index].ravel())
        for index, one in enumerate(job.parameters.values())
    ]
    return np.stack(columns, axis=1)


def _check_rows(job: SensitivityJob) -> None:
    """Refuse (LimitExceeded) more points than there may be, and rows that leave a sequence uneven.

    The latter with InvalidInput.
    """
    width = READ[job.design].width(len(job.parameters))
    fit = MOST_POINTS // width
    below = 1 << (min(job.samples, fit).bit_length() - 1)
    if job.samples > fit:
        most = below if job.design == OF_A_SEQUENCE else fit
        raise LimitExceeded.at(
            "/samples",
            f"{job.samples} rows of {width} points are {job.samples * width:.7g}; the limit is"
            f" {MOST_POINTS}. {most} rows fit.",
        )
    if job.design == OF_A_SEQUENCE and job.samples != below:
        sentence = f"The design saltelli has a power of two rows, such as {below} or {2 * below}."
        raise InvalidInput.at("/samples", sentence)


def _outside(name: str, one: Distribution, parameter: Parameter) -> Iterator[Problem]:
    """Yield bounds of a distribution that lie outside of what the parameter allows."""
    for field in one.ends():
        bound = getattr(one, field)
        if _beyond(np.array([bound]), parameter)[0]:
            sentence = f"It is {bound:.12g}; '{name}' {allowed_range(parameter)}."
            yield Problem(f"/parameters/{name}/{field}", sentence)


def _beyond(values: Floats, parameter: Parameter) -> Flags:
    low = -np.inf if parameter.minimum is None else parameter.minimum
    high = np.inf if parameter.maximum is None else parameter.maximum
    return ~((low <= values) & (values <= high))
