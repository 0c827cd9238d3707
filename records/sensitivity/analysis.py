"""One output of a design asked about: measures, quantiles and a limit, each with its interval."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from statistics import NormalDist
from typing import Any, Final, Literal, NamedTuple

import numpy as np

from jointplay.records.arrays import Flags, Floats
from jointplay.records.channel import Channel
from jointplay.records.point import PointStatus, has_ended
from jointplay.records.sensitivity import DESIGNS, Design
from jointplay.records.sensitivity.outputs import channel_beneath, output, outputs
from jointplay.records.sensitivity.quantiles import quantiles
from jointplay.records.sensitivity.resampled import between, resampled_means, resamples_of
from jointplay.records.study import StudySource
from jointplay.records.suggestions import unknown

Side = Literal["above", "below"]
"""Where the output fails: on this side of a limit."""
SHARES: Final = (0.05, 0.25, 0.5, 0.75, 0.95)
FEWEST_ROWS: Final = 4
"""Rows from which anything is said."""
_CONSTANT: Final = 1e-13
"""Outputs that differ by less of their size are the same."""
_ERROR: Final = 10.0
"""Tolerances that runs may be wrong by."""


class NoSuchOutput(ValueError):
    """The study has no output of that name; the sentence says which there are."""


class Estimate(NamedTuple):
    """Numbers with the ends of their intervals."""

    values: Floats
    low: Floats
    high: Floats


@dataclass(frozen=True)
class Question:
    """A question about one output.

    Parameters
    ----------
    output
        One of `outputs`; by default the first.
    limit
        Of the output, in its unit; how probable it is beyond.
    failing
        Side of the limit that is asked for.
    confidence
        Of all intervals.
    """

    output: str | None = None
    limit: float | None = None
    failing: Side = "above"
    confidence: float = 0.95


@dataclass(frozen=True, eq=False)
class Analysis:
    """The rows of a design that are whole, and what they say of one output."""

    design: Design
    parameters: int
    question: Question
    values: Floats
    """(rows, width, parameters) of the rows that count."""
    outputs: Floats
    """(rows, width)."""
    error: float = 0.0
    """By which runs alone may make outputs differ, in their unit."""

    @cached_property
    def varies(self) -> bool:
        """Whether there is something to explain."""
        size = float(np.abs(self.outputs).max(initial=0.0))
        return len(self.outputs) >= FEWEST_ROWS and float(np.ptp(self.outputs)) > _CONSTANT * size

    @cached_property
    def doubtful(self) -> bool:
        """Whether errors of the runs may be all that varies."""
        return self.varies and float(np.ptp(self.outputs)) <= self.error

    @cached_property
    def sample(self) -> Floats:
        """(rows, drawn) outputs at points that are drawn from the distributions."""
        return self.outputs[:, self.design.drawn(self.parameters)]

    def spreads(self) -> tuple[dict[str, Estimate], Estimate | None]:
        """Return (parameters,) of each measure, and (shares,) quantiles.

        No measures where the output does not vary, no quantiles of a design that is no sample.
        """
        if len(self.outputs) < FEWEST_ROWS:
            return {}, None
        centre = self.sample.mean() if self.sample.size else self.outputs.mean()
        moments = self.design.moments(self.values, self.outputs - centre)
        confidence = self.question.confidence
        best = self.design.measured(moments.mean(axis=0), self.parameters)
        others = self.design.measured(resampled_means(moments), self.parameters)
        measures = {
            name: Estimate(one, *between(others[name], confidence)) for name, one in best.items()
        }
        spread = None
        if self.sample.size:
            spread = Estimate(*quantiles(self.sample.ravel(), np.array(SHARES), confidence))
        return measures if self.varies else {}, spread

    def failure(self) -> tuple[float, float, float] | None:
        """Return the probability beyond the limit and its interval by Wilson; None: not asked."""
        limit, n = self.question.limit, self.sample.size
        if limit is None or not n:
            return None
        beyond = self.sample > limit if self.question.failing == "above" else self.sample < limit
        share = float(beyond.mean())
        z = NormalDist().inv_cdf(0.5 + 0.5 * self.question.confidence)
        middle = (share + z * z / (2 * n)) / (1 + z * z / n)
        reach = z / (1 + z * z / n) * (share * (1 - share) / n + (z / (2 * n)) ** 2) ** 0.5
        return share, max(middle - reach, 0.0), min(middle + reach, 1.0)


def sensitivity(source: StudySource, question: Question) -> dict[str, Any]:
    """Return what a study of the kind sensitivity says of one output, as the service shows it.

    Raises
    ------
    NoSuchOutput
        The study does not have the output.
    """
    known = outputs(source)
    name = next(iter(known)) if question.output is None else question.output
    if name not in known:
        raise NoSuchOutput(unknown("output", name, known))
    design = DESIGNS[source.attributes["job"]["design"]]
    parameters = len(source.parameters)
    shape = (-1, design.width(parameters))
    found = output(source, name).reshape(shape)
    ended = has_ended(source.status).reshape(shape)
    done = (source.status == PointStatus.done).reshape(shape)
    used = (done & np.isfinite(found)).all(axis=1)
    lost = (ended & ~(done & np.isfinite(found))).any(axis=1)
    values = source.values.reshape(*shape, parameters)[used]
    error = _ERROR * source.attributes["job"].get("tolerance", 0.0) * _size(source, name, done)
    analysis = Analysis(design, parameters, question, values, found[used], error)
    return {
        "complete": bool(ended.all()),
        "design": source.attributes["job"]["design"],
        "parameters": [one.name for one in source.parameters],
        "output": name,
        "unit": known[name].unit,
        "long_name": known[name].long_name,
        "outputs": list(known),
        "rows": (rows := _rows(used, lost, int((ended & ~done).sum()), design.width(parameters))),
        "confidence": question.confidence,
        "resamples": resamples_of(int(used.sum())),
        **_answers(analysis, known[name], rows),
    }


def _size(source: StudySource, name: str, done: Flags) -> float:
    """Return what errors of an output are shares of: the largest value of its channel, if any.

    done : any shape, those that count: a run that fails may have come to any value before.
    """
    channel = channel_beneath(source, name)
    ends = [name] if channel is None else [f"{channel}.minimum", f"{channel}.maximum"]
    values = np.abs([output(source, one)[done.ravel()] for one in ends])
    return float(values[np.isfinite(values)].max(initial=0.0))


def _rows(used: Flags, lost: Flags, failed: int, width: int) -> dict[str, int]:
    return {
        "used": int(used.sum()),
        "left_out": int(lost.sum()),
        "waiting": int((~used & ~lost).sum()),
        "failed_points": failed,
        "points_each": width,
    }


def _answers(analysis: Analysis, about: Channel, rows: Mapping[str, int]) -> dict[str, Any]:
    question, sample = analysis.question, analysis.sample
    enough = len(sample) >= FEWEST_ROWS and sample.size > 0
    (measures, spread), failure = analysis.spreads(), analysis.failure()
    described = analysis.design.measures
    return {
        "note": _note(analysis, rows),
        "mean": float(sample.mean()) if enough else None,
        "standard_deviation": float(sample.std()) if enough else None,
        "measures": {
            name: {
                "unit": about.unit if described[name].in_unit_of_output else "1",
                "long_name": described[name].long_name,
                **_columns(one),
            }
            for name, one in measures.items()
        },
        "quantiles": None if spread is None else {"shares": list(SHARES), **_columns(spread)},
        "failure": None
        if failure is None
        else {
            "limit": question.limit,
            "failing": question.failing,
            **dict(zip(("probability", "low", "high"), failure, strict=True)),
        },
    }


def _note(analysis: Analysis, rows: Mapping[str, int]) -> str:
    """Return why there is less than was asked for, or what it is not of; mostly empty."""
    lost, ended = rows["left_out"], rows["used"] + rows["left_out"]
    if len(analysis.outputs) < FEWEST_ROWS:
        if rows["waiting"]:
            return f"Less than {FEWEST_ROWS} rows are whole: nothing can be said yet."
        return (
            f"Only {rows['used']} of {ended} rows are whole, in the others a point failed or lacks"
            f" the output: of less than {FEWEST_ROWS} nothing can be said."
        )
    parts, there = [], ""
    if lost:
        there = " there"
        parts.append(
            f"In {lost} of {ended} rows a point failed or lacks the output: all numbers are of the"
            " others, not of the whole distributions."
        )
    if not analysis.varies:
        counted = "all points that count" if lost else "all points"
        parts.append(f"The output is the same at {counted}: no parameter matters to it{there}.")
    elif analysis.question.limit is not None and not analysis.sample.size:
        parts.append("The design is no sample of the distributions: it gives no probabilities.")
    if analysis.doubtful:
        parts.append(
            f"The output varies by {np.ptp(analysis.outputs):.2g}, and errors of the runs may make"
            f" {analysis.error:.2g} of that: what parameters do to it a smaller tolerance tells."
        )
    return " ".join(parts)


def _columns(estimate: Estimate) -> dict[str, list[float | None]]:
    return {
        name: [float(one) if np.isfinite(one) else None for one in column]
        for name, column in estimate._asdict().items()
    }
