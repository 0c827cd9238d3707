"""Peaks of channels as a table."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from jointplay.client import Peak
    from jointplay.source import Source


def with_units(source: "Source") -> dict[str, "Peak"]:
    """Return the peaks of a store as the service would send them."""
    from jointplay.client import Peak

    units = {channel.name: channel.unit for channel in source.channels}
    return {
        name: Peak(units[name], peak.minimum, peak.minimum_time, peak.maximum, peak.maximum_time)
        for name, peak in source.peaks().items()
    }


def headline(source: "Source") -> list[str]:
    """Return the channels to look at first: declared outputs and contact forces, else all."""
    stored = [channel.name for channel in source.channels]
    outputs = [output["name"] for output in source.attributes["scene"].get("outputs", [])]
    forces = [f"{joint}.normal_force" for joint in source.joints]
    return [name for name in outputs + forces if name in stored] or stored


def print_peaks(peaks: Mapping[str, "Peak"]) -> None:
    """Print one line for each channel."""
    if not peaks:
        return
    width = max(map(len, peaks))
    typer.echo(f"{'channel':{width}} {'minimum':>14}  at t [s]   {'maximum':>14}  at t [s]   unit")
    for name, peak in peaks.items():
        low = f"{peak.minimum:14.7g}  {peak.minimum_time:<9.6g}"
        high = f"{peak.maximum:14.7g}  {peak.maximum_time:<9.6g}"
        typer.echo(f"{name:{width}} {low}  {high}  {peak.unit}")


def write_peaks(path: Path, peaks: Mapping[str, "Peak"]) -> None:
    """Write the peaks as CSV, with 17 significant digits."""
    rows = ["channel,unit,minimum,minimum_time [s],maximum,maximum_time [s]"]
    for name, peak in peaks.items():
        values = (peak.minimum, peak.minimum_time, peak.maximum, peak.maximum_time)
        rows.append(",".join([name, peak.unit, *(f"{value:.17g}" for value in values)]))
    path.write_text("\n".join(rows) + "\n")
