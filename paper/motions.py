"""Kind of motion, in sections and diagrams: exponents, verdicts, extents beside the words."""

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from jointplay.paper import cases, reported
from jointplay.paper.cases import Stores
from jointplay.paper.comparison import Cell, Row, signed, small
from jointplay.paper.variants import Variant
from jointplay.records.arrays import Flags, Floats
from jointplay.solver.nonlinear.estimate import SIGNIFICANT, Estimate
from jointplay.storage.studies.reader import StudyReader

Members = Flags | slice
EVERY = slice(None)
_UNKNOWN = "exponent not computed"
_QUANTILES = (0.1, 0.5, 0.9)
_NEAR = 5
"""Neighbouring values of a parameter over which the extent in a diagram is smoothed."""


def mean_exponent(study: StudyReader, members: Members = EVERY) -> Estimate | None:
    """Return the mean largest Lyapunov exponent of points, 1/s, of the whole system.

    The error covers their own errors and their scatter; None if no exponent was computed.
    """
    values = study.indicators.get("lyapunov")
    if values is None:
        return None
    errors = study.indicators["lyapunov_error"][members]
    known = np.isfinite(values[members]) & np.isfinite(errors)
    if not known.any():
        return None
    mine, errors = values[members][known], errors[known]
    count = len(mine)
    scatter = float(mine.std(ddof=1)) / math.sqrt(count) if count > 1 else 0.0
    own = float(np.sqrt((errors**2).sum())) / count
    return Estimate(float(mine.mean()), max(scatter, own))


def tally(study: StudyReader, members: Members = EVERY) -> list[tuple[str, int]]:
    """Return how many of some points have which verdict, the most frequent first."""
    codes = study.verdicts
    if codes is None:
        return []
    return Counter(study.verdict_names[code] for code in codes[members] if code >= 0).most_common()


def in_words(verdicts: Sequence[tuple[str, int]]) -> str:
    """Return a tally as text: the word alone if it is the only one."""
    if len(verdicts) <= 1:
        return verdicts[0][0] if verdicts else "no verdict"
    total = sum(count for _, count in verdicts)
    return ", ".join(f"{word} {100 * count / total:.0f} %" for word, count in verdicts)


def rows(stores: Stores, variants: Sequence[Variant]) -> Iterator[Row]:
    """Set verdicts beside the words on phase portraits and sections."""
    for case, entry in enumerate(reported.document()["phase_ranges"]):
        words = entry["words"]
        cells = [
            _cell(
                stores.study("settled", case, variant),
                2.0 / entry["omega_over_pi"],
                _in_diagram(stores, variant, entry),
            )
            for variant in variants
        ]
        yield Row(
            (),
            reported.case_name(entry),
            ", ".join(entry["figures"]),
            "; ".join(f"{joint}: {words[joint]}" for joint in cases.JOINTS),
            tuple(cells),
            ("system", "window", "tolerance"),
        )


def _cell(study: StudyReader, period: float, elsewhere: Estimate | None) -> Cell:
    exponent = mean_exponent(study)
    details = [_UNKNOWN]
    if exponent:
        turn = small(exponent.value * period, 0.005)
        details = [f"λ = {_written(exponent)}", f"{turn} a revolution"]
    zero_one, recurrence = (_median(study, name) for name in ("zero_one", "period"))
    if math.isfinite(zero_one):
        details.append(f"0–1 test {signed(zero_one, '.2f')}")
    if recurrence > 0.0:
        details.append(f"recurs after {recurrence:g}")
    if elsewhere:
        details.append(f"in the diagram λ = {_written(elsewhere)}")
    return Cell(in_words(tally(study)), tuple(details))


def _written(exponent: Estimate) -> str:
    return str(exponent).replace("-", "−") + " 1/s"


def _in_diagram(stores: Stores, variant: Variant, entry: Mapping[str, Any]) -> Estimate | None:
    """Return the exponent of the same motion in a bifurcation diagram, if it is there."""
    parameters = reported.parameters(entry)
    for which, shown in enumerate(reported.document()["bifurcation"]):
        name, _ = reported.SETTINGS[shown["parameter"]]
        study = stores.study("diagram", which, variant)
        here = np.isclose(study.values[:, 0], parameters[name], rtol=1e-9, atol=0.0)
        if here.any() and reported.parameters(shown).items() <= parameters.items():
            return mean_exponent(study, here)
    return None


def _median(study: StudyReader, name: str) -> float:
    values = study.indicators.get(name)
    if values is None or not np.isfinite(values).any():
        return math.nan
    return float(np.nanmedian(values))


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


def diagram_rows(stores: Stores, which: int, variants: Sequence[Variant]) -> Iterator[Row]:
    """Set the diagram's numbers beside the words on each interval."""
    entry = reported.document()["bifurcation"][which]
    for words in entry["reported"]:
        low, high = words["interval"]
        studies = [stores.study("diagram", which, variant) for variant in variants]
        cells = [_diagram_cell(study, entry, words) for study in studies]
        yield Row(
            (),
            f"{low:g} to {high:g} {entry['unit']}",
            f"{words['joint']}, {' and '.join(words['axes'])}",
            words["words"],
            tuple(cells),
            ("system", "window", "tolerance"),
        )


def _diagram_cell(study: StudyReader, entry: Mapping[str, Any], words: Mapping[str, Any]) -> Cell:
    inside = _inside(study, entry["parameter"], words)
    if not inside.any():
        return Cell("no value computed")
    details = [_UNKNOWN]
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
    return float(np.median(extent)), float(np.median(known)) if len(known) else math.nan


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
