"""Peaks of the response to the start: as printed, true, and sampled as the publication did."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Final, NamedTuple

import numpy as np

from jointplay.paper import cases, reported
from jointplay.paper.cases import Stores
from jointplay.paper.comparison import Cell, Row, milliseconds, signed
from jointplay.paper.variants import Variant
from jointplay.storage.results.reader import ResultReader

_CHANNELS: Final = {
    "displacement_mm": ("displacement", "displacement, mm"),
    "acceleration": ("acceleration", "acceleration, m/s²"),
    "force_A": ("A.normal_force", "force at A, N"),
    "force_B": ("B.normal_force", "force at B, N"),
}
"""By key of `response_peaks`: channel, and words with the unit for readers."""
IMPACTS: Final = ("acceleration", "force_A", "force_B")
"""Keys of `response_peaks` whose peaks are those of impacts."""
PROGRAMS: Final = {"matlab": "their program", "adams": "ADAMS"}
"""The two programs that the publication compares."""


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


class Printed(NamedTuple):
    """A printed peak in the unit of the document, its time [s] and where both are printed."""

    value: float
    time: float | None
    pointers: tuple[str, ...]

    @property
    def shown(self) -> str:
        """The peak and its time for readers."""
        at = "" if self.time is None else f" at {milliseconds(self.time)}"
        return f"{self.value:g}{at}"


class Impact(NamedTuple):
    """A printed peak of an impact and ours."""

    printed: Printed
    ours: Extreme

    @property
    def ratio(self) -> float:
        """Ours, sampled like theirs, over the printed one."""
        return abs(self.ours.sampled) / self.printed.value

    @property
    def is_same(self) -> bool:
        """Both fall on the same instant of the publication's grid, or on neighbours."""
        time, grid = self.printed.time, float(reported.document()["grid"])
        return time is not None and abs(self.ours.sampled_time - time) < 1.5 * grid


def extreme(reader: ResultReader, channel: str) -> Extreme:
    """Return the true and the sampled extreme of a channel."""
    value, when = reader.peaks()[channel].larger
    stride = round(reported.document()["grid"] / cases.STEP)
    time, samples = reader.history([channel])
    values = samples[channel][::stride]
    index = int(np.abs(values).argmax())
    return Extreme(value, when, float(values[index]), float(time[::stride][index]))


def impacts(stores: Stores, variant: Variant) -> list[Impact]:
    """Return all printed peaks of impacts beside ours."""
    return [
        Impact(
            _printed(entry, key, ""),
            extreme(stores.run("response", case, variant), _CHANNELS[key][0]),
        )
        for case, entry in enumerate(reported.document()["response_peaks"])
        for key in IMPACTS
    ]


def strokes(stores: Stores, variant: Variant) -> list[float]:
    """Return by how much [m] the peaks of the displacement differ from the printed ones."""
    return [
        abs(
            extreme(stores.run("response", case, variant), "displacement").value
            - 1e-3 * entry["displacement_mm"]
        )
        for case, entry in enumerate(reported.document()["response_peaks"])
        if "displacement_mm" in entry
    ]


def ideal(stores: Stores, variants: Sequence[Variant]) -> Row:
    """Compare the stroke of the ideal mechanism."""
    printed = reported.document()["ideal"]["displacement_peak_mm"]
    found = extreme(stores.run("ideal", "1pi"), "displacement")
    cells = (_smooth(found, printed),) * len(variants)
    pointers = ("/ideal/displacement_peak_mm",)
    return Row(pointers, "no clearance", _CHANNELS["displacement_mm"][1], f"{printed:g}", cells)


def rows(stores: Stores, chosen: Sequence[int], variants: Sequence[Variant]) -> Iterator[Row]:
    """Compare entries of `response_peaks`."""
    for case in chosen:
        entry = reported.document()["response_peaks"][case]
        for key, (channel, words) in _CHANNELS.items():
            if key not in entry:
                continue
            printed = _printed(entry, key, f"/response_peaks/{case}")
            found = [extreme(stores.run("response", case, one), channel) for one in variants]
            if channel == "displacement":
                cells = tuple(_smooth(one, printed.value) for one in found)
                causes: tuple[str, ...] = ("clearance",)
            else:
                cells = tuple(_impact(one, printed.value) for one in found)
                causes = ("sampling", "contact", "order")
            name = reported.case_name(entry)
            yield Row(printed.pointers, name, words, printed.shown, cells, causes)


def load_cases(stores: Stores, variant: Variant) -> Iterator[Row]:
    """Compare the peaks of two programs; the columns are the gravities, of one variant."""
    entry = reported.document()["adams_comparison"]
    name = reported.case_name(entry)
    readers = [stores.run("gravity", gravity, variant) for gravity in cases.GRAVITIES]
    for program, words in PROGRAMS.items():
        shown = f"{1e3 * entry['displacement_m'][program]:.1f}"
        found = [extreme(reader, "displacement") for reader in readers]
        cells = tuple(Cell(f"{1e3 * one.value:.2f}") for one in found)
        pointers = (f"/adams_comparison/displacement_m/{program}",)
        yield Row(pointers, name, f"displacement by {words}, mm", shown, cells, ("gravity",))
    for program, words in PROGRAMS.items():
        printed = _printed(entry["acceleration"], program, "/adams_comparison/acceleration")
        found = [extreme(reader, "acceleration") for reader in readers]
        cells = tuple(_impact(one) for one in found)
        quantity, causes = f"acceleration by {words}, m/s²", ("gravity", "sampling", "order")
        yield Row(printed.pointers, name, quantity, printed.shown, cells, causes)


def _printed(entry: dict[str, Any], key: str, pointer: str) -> Printed:
    """Return a peak that is printed alone, beside its time, or as a pair with it."""
    value, time = entry[key], entry.get(f"{key}_time")
    if isinstance(value, list):
        pointers = [f"{pointer}/{key}/{i}" for i, one in enumerate(value) if one is not None]
        return Printed(value[0], value[1], tuple(pointers))
    beside = [f"{pointer}/{key}_time"] if time is not None else []
    return Printed(value, time, (f"{pointer}/{key}", *beside))


def _smooth(found: Extreme, printed: float) -> Cell:
    """Return a displacement [mm]: the grid loses nothing of it."""
    return Cell(f"{1e3 * found.value:.2f}", (), 1e3 * found.value / printed)


def _impact(found: Extreme, printed: float | None = None) -> Cell:
    return Cell(
        f"{signed(found.value, '.4g')} at {milliseconds(found.time)}",
        (f"sampled {signed(found.sampled, '.4g')} at {milliseconds(found.sampled_time)}",),
        None if printed is None else abs(found.sampled) / printed,
    )
