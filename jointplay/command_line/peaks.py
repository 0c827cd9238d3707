"""Peaks of channels as a table."""

from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, NamedTuple

import typer

if TYPE_CHECKING:
    from jointplay.client import Peak
    from jointplay.records.run import Source


class Row(NamedTuple):
    """Extremes of one channel, in its unit, each with its time in s."""

    channel: str
    unit: str
    minimum: float
    minimum_time: float
    maximum: float
    maximum_time: float


def rows_of(peaks: Mapping[str, "Peak"]) -> Iterator[Row]:
    """Yield the peaks of a simulation, in the order of the channels."""
    for name, peak in peaks.items():
        low, high = (peak.minimum, peak.minimum_time), (peak.maximum, peak.maximum_time)
        yield Row(name, peak.unit, *low, *high)


def headline(source: "Source") -> list[str]:
    """Return the channels to look at first: declared outputs and contact forces, else all."""
    stored = [channel.name for channel in source.channels]
    outputs = [output["name"] for output in source.attributes["scene"].get("outputs", [])]
    forces = [f"{joint}.normal_force" for joint in source.joints]
    return [name for name in outputs + forces if name in stored] or stored


def print_peaks(rows: Iterable[Row]) -> None:
    """Print one line for each channel."""
    rows = list(rows)
    if not rows:
        return
    width = max(len(row.channel) for row in rows)
    typer.echo(f"{'channel':{width}} {'minimum':>14}  at t [s]   {'maximum':>14}  at t [s]   unit")
    for row in rows:
        low = f"{row.minimum:14.7g}  {row.minimum_time:<9.6g}"
        high = f"{row.maximum:14.7g}  {row.maximum_time:<9.6g}"
        typer.echo(f"{row.channel:{width}} {low}  {high}  {row.unit}")


def peak_lines(rows: Iterable[Row]) -> Iterator[str]:
    """Yield the peaks as lines of CSV, with 17 significant digits."""
    yield "channel,unit,minimum,minimum_time [s],maximum,maximum_time [s]\n"
    for channel, unit, *values in rows:
        yield ",".join([channel, unit, *(f"{value:.17g}" for value in values)]) + "\n"
