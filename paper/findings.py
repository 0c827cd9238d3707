"""Numbers of the report's sentences; the sentences are in its template."""

from collections.abc import Iterator, Sequence
from typing import Any, Final

import numpy as np

from jointplay.paper import cases, motions, peaks, ranges, reported
from jointplay.paper.cases import Stores
from jointplay.paper.comparison import Cell, Row
from jointplay.paper.variants import AS_PUBLISHED, CONSTANT, MATERIAL, SLIPS, Size, Variant

OVERVIEW: Final = (
    "reading",
    "displacement, largest difference",
    "same impact",
    "their peaks, ours over printed",
    "all peaks of impacts",
    "widths in x",
    "widths of rates",
)
"""Titles of the columns of `overview`."""
_BED: Final = {
    "single_plot_peak": "peak of the acceleration, both in one plot",
    "cycle30_experiment": "cycle 30, experiment",
    "cycle30_theory": "cycle 30, theory",
}


def findings(stores: Stores, size: Size) -> dict[str, Any]:
    """Return every number of the sentences, by its name in the template; lengths in m."""
    printed = reported.document()
    true, published = (Variant(CONSTANT, slip) for slip in (MATERIAL, AS_PUBLISHED))
    found = [one for variant in size.variants for one in peaks.impacts(stores, variant)]
    timed = [one for one in peaks.impacts(stores, published) if one.printed.time is not None]
    same = [one for one in timed if one.is_same]
    strokes = {
        gravity: peaks.extreme(stores.run("gravity", gravity, true), "displacement").value
        for gravity in cases.GRAVITIES
    }
    first, last = 0, len(printed["phase_ranges"]) - 1
    return {
        "worst_stroke": max(max(peaks.strokes(stores, variant)) for variant in size.variants),
        "impacts_timed": len(timed),
        "impacts_same": len(same),
        "impact_times": sorted({one.printed.time for one in same if one.printed.time}),
        "impact_ratios": [one.ratio for one in same],
        "spans": [
            (printed["phase_ranges"][case], ranges.found(stores, "late", true, case, "A", "x"))
            for case in (first, last)
        ],
        "motions": list(_motions(stores, size)),
        "rises": list(_rises(stores, size)),
        "strokes": strokes,
        "nearest": {
            words: (stroke, min(strokes, key=lambda one: abs(strokes[one] - stroke)))
            for program, words in peaks.PROGRAMS.items()
            for stroke in [printed["adams_comparison"]["displacement_m"][program]]
        },
        "shares": [abs(one.ours.sampled / one.ours.value) for one in found],
        "rates": {
            (window, variant.slip.name): ranges.found(stores, window, variant, 0, "B", "v").high
            for variant in (true, published)
            for window in ranges.WINDOWS
        },
        "weakening": list(_weakening(stores, size)),
        "bed": [one["cycle30_experiment"] / one["cycle30_theory"] for one in printed["test_bed"]],
    }


def overview(stores: Stores, variants: Sequence[Variant]) -> Iterator[tuple[str, ...]]:
    """Yield how near each reading comes to what is printed, a line for each as in `OVERVIEW`."""
    for variant in variants:
        found = peaks.impacts(stores, variant)
        timed = [one for one in found if one.printed.time is not None]
        same = [one for one in timed if one.is_same]
        yield (
            variant.label,
            f"{1e3 * max(peaks.strokes(stores, variant)):.2f} mm",
            f"{len(same)} of {len(timed)}",
            _spread([one.ratio for one in same]),
            _spread([one.ratio for one in found]),
            *(_spread(ranges.widths(stores, variant, key)) for key in ranges.QUANTITIES),
        )


def experiment() -> Iterator[Row]:
    """List what is printed of the experiment, whose data do not suffice to compute it."""
    for index, entry in enumerate(reported.document()["test_bed"]):
        where = f"{entry['where']}: {reported.case_name(entry)}"
        ratio = entry["cycle30_experiment"] / entry["cycle30_theory"]
        for key, words in _BED.items():
            details = (f"their experiment is {ratio:.2f} times this",)
            cell = Cell("not computed", details if key == "cycle30_theory" else ())
            pointers = (f"/test_bed/{index}/{key}",)
            yield Row(pointers, where, f"{words}, m/s²", f"{entry[key]:g}", (cell,), ("bed",))


def _motions(stores: Stores, size: Size) -> Iterator[tuple[dict[str, Any], int, list[float]]]:
    """Yield each printed motion, in how many readings ours is chaotic, and their exponents."""
    for case, entry in enumerate(reported.document()["phase_ranges"]):
        studies = [stores.study("settled", case, variant) for variant in size.motions]
        verdicts = [motions.tally(study) for study in studies]
        chaotic = sum(bool(found) and found[0][0] == "chaotic" for found in verdicts)
        exponents = [one.value for one in map(motions.mean_exponent, studies) if one]
        yield entry, chaotic, exponents


def _rises(
    stores: Stores, size: Size
) -> Iterator[tuple[str, list[tuple[float, float, float, str]]]]:
    """Yield by slip where the sections of B widen most as the speed grows."""
    for slip in SLIPS:
        rises = []
        for variant in size.motions:
            rise = motions.largest_rise(stores.study("diagram", 1, variant), "B")
            if variant.slip == slip and rise:
                value, before, after = rise
                speed = value / reported.si("omega_over_pi", 1.0)
                rises.append((speed, before, after, variant.law.label))
        if rises:
            yield slip.label, rises


def _weakening(stores: Stores, size: Size) -> Iterator[tuple[float, float, float, float]]:
    """Yield extent and exponent of B over the printed intervals of the speed, and their ends."""
    study = stores.study("diagram", 1, size.motions[-1])
    for words in reported.document()["bifurcation"][1]["reported"]:
        if words["joint"] == "B":
            yield (*motions.medians(study, "omega_over_pi", words), *words["interval"])


def _spread(ratios: Sequence[float]) -> str:
    if not ratios:
        return "none"
    return f"×{np.median(ratios):.2f} ({min(ratios):.2f} … {max(ratios):.2f})"
