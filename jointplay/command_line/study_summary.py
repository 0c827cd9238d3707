"""Summary of a study: a few lines and a table of its points."""

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

if TYPE_CHECKING:
    from jointplay.records.study import StudySource

_MOST_FAILURES = 5


def write_points(source: "StudySource", table: Path) -> None:
    """Write what has one value a point as comma-separated values."""
    from jointplay.exports import study as study_export

    channels = [channel.name for channel in source.channels]
    everything = range(source.points)
    table.write_text("".join(study_export.point_lines(source, channels, everything, units(source))))


def summary_of(source: "StudySource") -> dict[str, Any]:
    """Return how many points ended in which way, the verdicts, and all failures."""
    from jointplay.records.point import PointStatus

    counts = Counter(PointStatus(code).name for code in source.status)
    verdicts: Counter[str] | None = None
    if (codes := source.verdicts) is not None:
        verdicts = Counter(source.verdict_names[code] for code in codes if code >= 0)
    return {
        "number": source.points,
        "status": {word: counts[word] for word in PointStatus.__members__},
        "verdicts": None if verdicts is None else dict(verdicts.most_common()),
        "failures": [
            {"point": point, "code": one.code, "detail": one.detail, "time": one.time}
            for point, one in source.failures.items()
        ],
    }


def units(source: "StudySource") -> dict[str, str]:
    """Return the units of the statistics and indicators of points, by name."""
    from jointplay.solver.runs.study.outputs import OUTPUTS

    own = source.attributes.get("meanings", {})
    return {name: unit for name, (unit, _) in {**OUTPUTS, **own}.items()}


def print_points(source: "StudySource") -> None:
    """Print how many points ended in which way, the verdicts, the extremes, the first failures."""
    import numpy as np

    from jointplay.records.point import PointStatus

    summary = summary_of(source)
    for heading, counts in (("points", summary["status"]), ("verdicts", summary["verdicts"])):
        if counts is not None:
            listed = ", ".join(f"{number} {word}" for word, number in counts.items() if number)
            typer.echo(f"{heading:9} {listed}")
    done = source.status == PointStatus.done
    width = max((len(channel.name) for channel in source.channels), default=0)
    for channel in source.channels if done.any() else ():
        peaks = source.peaks(channel.name)
        low, high = peaks.minimum[done], peaks.maximum[done]
        typer.echo(
            f"{channel.name:{width}}  minimum {np.nanmin(low):.6g} to {np.nanmax(low):.6g},"
            f"  maximum {np.nanmin(high):.6g} to {np.nanmax(high):.6g} {channel.unit}"
        )
    for point, failure in list(source.failures.items())[:_MOST_FAILURES]:
        values = ", ".join(
            f"{parameter.name} = {value:g}"
            for parameter, value in zip(source.parameters, source.values[point], strict=True)
        )
        where = f"point {point}" + (f" ({values})" if values else "")
        typer.echo(f"failed    {where}: {failure.detail}")
    if len(source.failures) > _MOST_FAILURES:
        typer.echo(f"          and {len(source.failures) - _MOST_FAILURES} more")
