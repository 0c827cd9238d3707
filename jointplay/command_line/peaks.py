"""Peaks of channels as a table."""

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import typer

from jointplay.command_line.output import aligned

if TYPE_CHECKING:
    from jointplay.client import Peak
    from jointplay.records.run import Source


Row = dict[str, Any]
"""Extremes of one channel: its name, its unit and the numbers of a peak."""


def rows_of(peaks: Mapping[str, "Peak"]) -> list[Row]:
    """Return the peaks of a simulation, in the order of the channels."""
    from jointplay.records.peak import PEAK

    return [
        {"channel": name, "unit": one.unit, **{part: getattr(one, part) for part in PEAK}}
        for name, one in peaks.items()
    ]


def headline(source: "Source") -> list[str]:
    """Return the channels to look at first: declared outputs and contact forces, else all."""
    stored = [channel.name for channel in source.channels]
    outputs = [output["name"] for output in source.attributes["scene"].get("outputs", [])]
    forces = [f"{joint}.normal_force" for joint in source.joints]
    return [name for name in outputs + forces if name in stored] or stored


def print_peaks(rows: Sequence[Row], *names: str) -> None:
    """Print one line for each row: its channel and what else names it, then its numbers."""
    if not rows:
        return
    columns = ("channel", *names)
    numbers = f"{'minimum':>14}  at t [s]   {'maximum':>14}  at t [s]   unit"
    table = [[*columns, numbers]]
    for row in rows:
        low = f"{row['minimum']:14.7g}  {row['minimum_time']:<9.6g}"
        high = f"{row['maximum']:14.7g}  {row['maximum_time']:<9.6g}"
        table.append([*(row[name] for name in columns), f"{low}  {high}  {row['unit']}"])
    for line in aligned(table):
        typer.echo(line)


def peak_lines(rows: Sequence[Row]) -> Iterator[str]:
    """Yield the peaks as lines of CSV."""
    from jointplay.records.text_tables import csv_lines

    names = ("channel", "unit", "minimum", "minimum_time", "maximum", "maximum_time")
    titles = [f"{name} [s]" if name.endswith("_time") else name for name in names]
    yield from csv_lines(titles, [[[row[name] for row in rows] for name in names]])
