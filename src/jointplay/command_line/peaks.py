"""Peaks of channels, and impacts, as rows of a table."""

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from jointplay.command_line.output import aligned

if TYPE_CHECKING:
    from jointplay.client import Impacts, Peak
    from jointplay.records.run import Source

Row = dict[str, Any]
_ROUNDING = 1e-14


def peak_rows(peaks: Mapping[str, "Peak"]) -> list[Row]:
    """Return the peaks of a simulation, in the order of the channels."""
    from jointplay.records.peak import PEAK

    return [
        {"channel": name, "unit": one.unit, **{part: getattr(one, part) for part in PEAK}}
        for name, one in peaks.items()
    ]


def impact_rows(impacts: "Impacts", start: float | None, stop: float | None) -> list[Row]:
    """Return the contacts that begin from ``start`` to ``stop`` [s], in order of release."""
    from jointplay.records.impact import IMPACT_UNITS
    from jointplay.records.run import inside

    names = ("joint", *IMPACT_UNITS)
    columns = (impacts.joint, *(getattr(impacts, name).tolist() for name in IMPACT_UNITS))
    rows = (dict(zip(names, row, strict=True)) for row in zip(*columns, strict=True))
    shown = inside(impacts.onset, start, stop)
    return [row for row, is_shown in zip(rows, shown, strict=True) if is_shown]


def peak_lines(rows: Sequence[Row]) -> Iterator[str]:
    """Yield peaks as lines of CSV."""
    from jointplay.records.peak import PEAK

    units = {name: described.get("units", "") for name, described in PEAK.items()}
    return _lines(rows, {"channel": "", "unit": "", **units})


def impact_lines(rows: Sequence[Row]) -> Iterator[str]:
    """Yield impacts as lines of CSV, with 17 significant digits."""
    from jointplay.records.impact import IMPACT_UNITS

    return _lines(rows, {"joint": "", **IMPACT_UNITS})


def _lines(rows: Sequence[Row], units: Mapping[str, str]) -> Iterator[str]:
    from jointplay.records.text_tables import csv_lines

    titles = [f"{name} [{unit}]" if unit else name for name, unit in units.items()]
    return csv_lines(titles, [[[row[name] for row in rows] for name in units]])


def headline(source: "Source") -> list[str]:
    """Return the channels to look at first: declared outputs and contact forces, else all."""
    stored = [channel.name for channel in source.channels]
    outputs = [output["name"] for output in source.attributes["scene"].get("outputs", [])]
    forces = [f"{joint}.normal_force" for joint in source.joints]
    return [name for name in outputs + forces if name in stored] or stored


def peak_table(rows: Sequence[Row], *names: str) -> Iterator[str]:
    """Yield one line for each row: its channel and what else names it, then its numbers.

    An extreme that is rounding beside the other one is 0: that of a crank to the side, at 90°.
    """
    if not rows:
        return
    columns = ("channel", *names)
    numbers = f"{'minimum':>14}  at t [s]   {'maximum':>14}  at t [s]   unit"
    table = [[*columns, numbers]]
    for row in rows:
        minimum, maximum = row["minimum"], row["maximum"]
        low = f"{_not_rounding(minimum, maximum):14.7g}  {row['minimum_time']:<9.6g}"
        high = f"{_not_rounding(maximum, minimum):14.7g}  {row['maximum_time']:<9.6g}"
        table.append([*(row[name] for name in columns), f"{low}  {high}  {row['unit']}"])
    yield from aligned(table)


def _not_rounding(value: float, beside: float) -> float:
    return 0.0 if abs(value) <= _ROUNDING * abs(beside) else value + 0.0  # nor -0.0
