"""Bifurcation diagrams in numbers: verdicts, exponents and extent over the printed intervals."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from jointplay.paper import reported
from jointplay.paper.comparison import Cell, Row, small
from jointplay.paper.motions import UNKNOWN, in_words, mean_exponent, tally
from jointplay.paper.runs import Stores
from jointplay.paper.variants import Variant
from jointplay.records.arrays import Flags, Floats
from jointplay.solver.nonlinear.estimate import SIGNIFICANT
from jointplay.storage.studies import StudyReader

_QUANTILES = (0.1, 0.5, 0.9)
_NEAR = 5


def extent_of_sections(study: StudyReader, joint: str, axes: str) -> Floats:
    """Return (points,) extent of a joint's sections in units of its clearance, the larger axis."""
    extents = []
    for axis in axes:
        rows = study.sections(f"{joint}.eccentricity_{axis}")
        known = np.isfinite(rows).any(axis=1)
        extent = np.full(len(rows), np.nan)
        extent[known] = np.nanmax(rows[known], axis=1) - np.nanmin(rows[known], axis=1)
        extents.append(extent)
    if study.parameters[0].name == "clearance":
        clearance = study.values[:, 0]
    else:
        clearance = study.attributes["scene"]["joints"][joint]["clearance"]["radial_clearance"]
    return np.asarray(np.max(extents, axis=0) / clearance, np.float64)


def rows(stores: Stores, which: int, variants: Sequence[Variant]) -> Iterator[Row]:
    """Set the diagram's numbers beside the words on each interval."""
    entry = reported.document()["bifurcation"][which]
    for words in entry["reported"]:
        low, high = words["interval"]
        cells = [_cell(stores.study("diagram", which, one), entry, words) for one in variants]
        yield Row(
            (),
            f"{low:g} to {high:g} {entry['unit']}",
            f"{words['joint']}, {' and '.join(words['axes'])}",
            words["words"],
            tuple(cells),
            ("system", "window", "tolerance"),
        )


def _cell(study: StudyReader, entry: Mapping[str, Any], words: Mapping[str, Any]) -> Cell:
    inside = _inside(study, entry["parameter"], words)
    if not inside.any():
        return Cell("no value computed")
    details = [UNKNOWN]
    if mean_exponent(study, inside) is not None:
        exponents = study.indicators["lyapunov"][inside]
        part = exponents > SIGNIFICANT * study.indicators["lyapunov_error"][inside]
        details = [
            f"λ {_quantiles(exponents, 0.005)} 1/s",
            f"neighbours part at {100 * part.mean():.0f} %",
        ]
    extent = extent_of_sections(study, words["joint"], words["axes"])[inside]
    details.append(f"extent {_quantiles(extent, 0.0005)} c")
    return Cell(in_words(tally(study, inside)), tuple(details))


def medians(study: StudyReader, setting: str, words: Mapping[str, Any]) -> tuple[float, float]:
    """Return the medians of extent [clearances] and exponent [1/s] over a printed interval."""
    inside = _inside(study, setting, words)
    exponents = study.indicators.get("lyapunov", np.full(study.points, np.nan))[inside]
    extent = extent_of_sections(study, words["joint"], words["axes"])[inside]
    known = exponents[np.isfinite(exponents)]
    return float(np.median(extent)), float(np.median(known)) if len(known) else float("nan")


def largest_rise(study: StudyReader, joint: str) -> tuple[float, float, float] | None:
    """Return where a joint's extent rises most: the value [SI], and the extent before and after.

    Before and after are medians over five values of the parameter; None if there are too few.
    """
    extent = extent_of_sections(study, joint, "xy")
    if len(extent) <= 2 * _NEAR:
        return None
    medians = np.median(np.lib.stride_tricks.sliding_window_view(extent, _NEAR), axis=1)
    before, after = medians[:-_NEAR], medians[_NEAR:]
    index = int(np.nanargmax(after - before))
    return float(study.values[index + _NEAR, 0]), float(before[index]), float(after[index])


def _inside(study: StudyReader, setting: str, words: Mapping[str, Any]) -> Flags:
    """Return (points,) which lie in a printed interval, both its ends included."""
    low, high = (reported.si(setting, edge) for edge in words["interval"])
    values = study.values[:, 0]
    return np.asarray((values >= low * (1.0 - 1e-9)) & (values <= high * (1.0 + 1e-9)))


def _quantiles(values: Floats, bound: float) -> str:
    low, middle, high = (small(float(one), bound) for one in np.nanquantile(values, _QUANTILES))
    return f"{middle} ({low} … {high})"
