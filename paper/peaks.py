"""Peaks of the response to the start: as printed, true, and sampled as the publication did."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from jointplay.paper import cases, reported
from jointplay.paper.comparison import Cell, Row, milliseconds
from jointplay.paper.variants import Variant
from jointplay.storage.results import ResultReader

_CHANNELS: Final = {
    "displacement_mm": ("displacement", "displacement", "mm", 1e-3),
    "acceleration": ("acceleration", "acceleration", "m/s²", 1.0),
    "force_A": ("A.normal_force", "force at A", "N", 1.0),
    "force_B": ("B.normal_force", "force at B", "N", 1.0),
}
"""By key of the document: channel, words, unit for readers, what one is in SI."""


@dataclass(frozen=True)
class Extreme:
    """The extreme of the larger magnitude, with its sign [SI], and its time [s].

    `value` is the solver's, found between samples; `sampled` the one among the samples of the
    publication's grid.
    """

    value: float
    time: float
    sampled: float
    sampled_time: float


def extreme(reader: ResultReader, channel: str) -> Extreme:
    """Return the true and the sampled extreme of a channel."""
    peak = reader.peaks()[channel]
    low, high = (peak.minimum, peak.minimum_time), (peak.maximum, peak.maximum_time)
    value, when = max(low, high, key=lambda found: abs(found[0]))
    stride = round(reported.document()["grid"] / cases.STEP)
    time, samples = reader.history([channel])
    values = samples[channel][::stride]
    index = int(np.abs(values).argmax())
    return Extreme(value, when, float(values[index]), float(time[::stride][index]))


def ideal(folder: Path, variants: Sequence[Variant]) -> Row:
    """Compare the stroke of the ideal mechanism."""
    printed = reported.document()["ideal"]["displacement_peak_mm"]
    found = extreme(ResultReader(folder / cases.ideal(1.0)), "displacement")
    cell = Cell(f"{1e3 * found.value:.2f}", (), 1e3 * found.value / printed)
    pointers = ("/ideal/displacement_peak_mm",)
    return Row(
        pointers, "no clearance", "displacement, mm", f"{printed:g}", (cell,) * len(variants)
    )


def rows(folder: Path, chosen: Sequence[int], variants: Sequence[Variant]) -> Iterator[Row]:
    """Compare entries of `response_peaks`."""
    entries = reported.document()["response_peaks"]
    for case in chosen:
        stores = [ResultReader(folder / cases.response(case, variant)) for variant in variants]
        for key in _CHANNELS:
            if key in entries[case]:
                yield _row(entries[case], f"/response_peaks/{case}", key, stores)


def _row(entry: Mapping[str, Any], pointer: str, key: str, stores: Sequence[ResultReader]) -> Row:
    channel, words, unit, factor = _CHANNELS[key]
    pointers = [f"{pointer}/{key}"]
    printed, time = entry[key], entry.get(f"{key}_time")
    if isinstance(printed, list):
        pointers = [f"{pointer}/{key}/{i}" for i, one in enumerate(printed) if one is not None]
        printed, time = printed
    elif time is not None:
        pointers.append(f"{pointer}/{key}_time")
    shown = f"{printed:g}" + (f" at {milliseconds(time)}" if time is not None else "")
    cells = [_cell(extreme(store, channel), printed, factor) for store in stores]
    causes = ("clearance",) if channel == "displacement" else ("sampling", "contact", "order")
    return Row(
        tuple(pointers), reported.case_name(entry), f"{words}, {unit}", shown, tuple(cells), causes
    )


def _cell(found: Extreme, printed: float, factor: float) -> Cell:
    if factor != 1.0:  # a displacement: smooth, the grid loses nothing
        return Cell(f"{found.value / factor:.2f}", (), found.value / factor / printed)
    return Cell(
        f"{found.value:.4g} at {milliseconds(found.time)}",
        (f"sampled {found.sampled:.4g} at {milliseconds(found.sampled_time)}",),
        abs(found.sampled) / printed,
    )
