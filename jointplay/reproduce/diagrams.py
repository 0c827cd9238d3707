"""Bifurcation diagrams in numbers: verdicts, exponents and spread over the printed intervals."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from jointplay.reproduce import cases, reported
from jointplay.reproduce.comparison import Cell, Row
from jointplay.reproduce.motions import UNKNOWN, in_words, mean_exponent, tally
from jointplay.reproduce.variants import Variant
from jointplay.source import Floats
from storage.studies import StudyReader

_QUANTILES = (0.1, 0.5, 0.9)


def spread(study: StudyReader, joint: str, axes: str) -> Floats:
    """Return (points,) extent of a joint's sections in units of its clearance, the larger axis."""
    extents = []
    for axis in axes:
        rows = study.sections(f"{joint}.eccentricity_{axis}")
        known = np.isfinite(rows).any(axis=1)
        extent = np.full(len(rows), np.nan)
        extent[known] = np.nanmax(rows[known], axis=1) - np.nanmin(rows[known], axis=1)
        extents.append(extent)
    return np.asarray(np.max(extents, axis=0) / _clearances(study, joint), np.float64)


def rows(folder: Path, which: int, variants: Sequence[Variant]) -> Iterator[Row]:
    """Set the diagram's numbers beside the words on each interval."""
    entry = reported.document()["bifurcation"][which]
    studies = [StudyReader(folder / cases.diagram(which, variant)) for variant in variants]
    for words in entry["reported"]:
        low, high = words["interval"]
        yield Row(
            (),
            f"{low:g} to {high:g} {entry['unit']}",
            f"{words['joint']}, {' and '.join(words['axes'])}",
            words["words"],
            tuple(_cell(study, entry, words) for study in studies),
            ("system", "window"),
        )


def _cell(study: StudyReader, entry: Mapping[str, Any], words: Mapping[str, Any]) -> Cell:
    low, high = (reported.si(entry["parameter"], edge) for edge in words["interval"])
    values = study.values[:, 0]
    inside = (values >= low * (1.0 - 1e-9)) & (values <= high * (1.0 + 1e-9))
    if not inside.any():
        return Cell("no value computed")
    exponents = study.indicators.get("lyapunov")
    details = [UNKNOWN]
    if exponents is not None and mean_exponent(study, inside) is not None:
        small, middle, large = np.nanquantile(exponents[inside], _QUANTILES)
        details = [f"λ {middle:.2g} ({small:.2g} … {large:.2g}) 1/s"]
    extent = spread(study, words["joint"], words["axes"])[inside]
    small, middle, large = np.nanquantile(extent, _QUANTILES)
    details.append(f"extent {middle:.2g} c ({small:.2g} … {large:.2g})")
    return Cell(in_words(tally(study, inside)) or "no verdict", tuple(details))


def _clearances(study: StudyReader, joint: str) -> Floats:
    """Return (points,) clearances of a joint [m]."""
    if study.parameters[0].name == "clearance":
        return study.values[:, 0]
    scene = study.attributes["scene"]
    clearance = scene["joints"][joint]["clearance"]["radial_clearance"]
    return np.full(study.points, float(clearance))
