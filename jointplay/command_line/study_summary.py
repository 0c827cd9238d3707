"""What became of a study, in a few lines and a table of its points."""

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from jointplay.command_line import output_folder
from jointplay.command_line.exits import Exit, Stopped

if TYPE_CHECKING:
    from jointplay.study_source import StudySource

_MOST_FAILURES = 5


def summarise(output: Path) -> None:
    """Write points.csv and figures of a local study, and print what became of its points.

    Raises
    ------
    Stopped
        Not one point was computed, because all failed.
    """
    from jointplay import study_export
    from jointplay.command_line.drawing import draw_all
    from storage.studies import StudyReader

    source = StudyReader(output_folder.store_in(output))
    table = output / output_folder.POINTS_FILE
    channels = [channel.name for channel in source.channels]
    everything = range(source.points)
    table.write_text("".join(study_export.point_lines(source, channels, everything, units())))
    draw_all(source, output / output_folder.FIGURES, "png")
    print_points(source)
    typer.echo(f"all {source.points} points are in {table}")
    if len(source.failures) == source.points:
        raise Stopped(Exit.FAILED, "every point failed; the first one says why above")


def units() -> dict[str, str]:
    """Return the units of the statistics and indicators of points, by name."""
    from solver.study.meanings import INDICATORS, STATISTICS

    return {name: unit for name, (unit, _) in (STATISTICS | INDICATORS).items()}


def print_points(source: "StudySource") -> None:
    """Print how many points ended in which way, the verdicts, the extremes, the first failures."""
    import numpy as np

    from jointplay.study_source import DONE, STATUS

    counts = Counter(STATUS[code] for code in source.status)
    typer.echo(
        "points    " + ", ".join(f"{counts[word]} {word}" for word in STATUS if counts[word])
    )
    codes = source.verdicts
    if codes is not None:
        verdicts = Counter(source.verdict_names[code] for code in codes if code >= 0)
        typer.echo("verdicts  " + ", ".join(f"{n} {word}" for word, n in verdicts.most_common()))
    done = source.status == DONE
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
