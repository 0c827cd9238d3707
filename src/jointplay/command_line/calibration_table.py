"""Findings of a calibration, as tables and sentences."""

from collections.abc import Iterator
from itertools import combinations
from typing import Any

from jointplay.command_line.output import aligned
from jointplay.records.calibration_coverage import coverage
from jointplay.records.calibration_misfit import best_at, misfits

ROUGH = 0.5  # tolerances: more than that between neighbours is no place for a fit
TOGETHER = 0.8  # correlation from which parameters are said to make up for one another


def calibration_lines(document: dict[str, Any]) -> Iterator[str]:
    """Yield the targets beside what was fitted, the parameters with their spread, and notes."""
    targets, parameters = document["targets"], document["parameters"]
    yield from aligned([_TARGET_HEAD, *map(_target_row, targets)])
    yield ""
    rows = [(*_parameter_row(one), _ends(document, one)) for one in parameters]
    yield from aligned([_PARAMETER_HEAD, *rows])
    yield ""
    yield from _notes(document)


_TARGET_HEAD = (
    "case",
    "target",
    "window [s]",
    "wanted",
    "fitted",
    "miss",
    "equally good",
    "rough",
    "",
)


def _target_row(target: dict[str, Any]) -> tuple[str, ...]:
    wanted = target["between"]
    shown = (
        f"{target['value']:g}"
        if wanted is None
        else " to ".join("..." if value is None else f"{value:g}" for value in wanted)
    )
    rough = target["roughness"]
    return (
        target["case"],
        f"{target['statistic'].replace('_', ' ')} of {target['channel']} [{target['unit']}]",
        f"{target['from']:g} to {target['to']:g}",
        shown,
        _number(target["fitted"]),
        "none" if target["miss"] is None else f"{target['miss']:+.2f}",
        f"{_number(target['lowest'])} to {_number(target['highest'])}",
        "none" if rough is None else f"{rough:.2f}" + ("!" if rough > ROUGH else ""),
        "" if target["weight"] > 0 else "not fitted",
    )


_PARAMETER_HEAD = ("parameter", "fitted", "unit", "5 % to 95 %", "lowest to highest", "")


def _parameter_row(parameter: dict[str, Any]) -> tuple[str, ...]:
    quantiles = parameter["quantiles"]
    return (
        parameter["name"],
        f"{parameter['best']:g}",
        parameter["unit"],
        f"{quantiles['0.05']:.3g} to {quantiles['0.95']:.3g}",
        f"{parameter['lowest']:.3g} to {parameter['highest']:.3g}",
    )


def _ends(document: dict[str, Any], parameter: dict[str, Any]) -> str:
    """Return what is to be said of the ends of a parameter's range."""
    best = best_at(document, parameter)
    if best:
        return f"best at its {best}: better ones may lie beyond"
    ends = " and ".join(parameter["open_ends"])
    return f"reaches its {ends}: the targets set no end there" if ends else ""


def _notes(document: dict[str, Any]) -> Iterator[str]:
    search, limit = document["search"], document["equally_good_cost"]
    factor = document["calibration"]["spread"]["factor"]
    yield (
        f"cost {document['cost']:.3g}: the root mean square of the misses, in tolerances; up to"
        f" {limit:.3g} ({factor:g} times the best, or 1) fits equally well"
    )
    yield from _coverage(document)
    yield from _pairs(document["correlation"])
    rough = [t for t in document["targets"] if (t["roughness"] or 0.0) > ROUGH]
    if rough:
        fitted = sum(target["weight"] > 0 for target in rough)
        yield (
            f"impacts make {len(rough)} of the targets rough (!), {fitted or 'none'} of the fitted"
            f" ones: they change by more than {ROUGH:g} tolerances between parameters that differ"
            " by a ten-thousandth of their range, and no fit is sharper than that"
        )
    if not search["settled"]:
        yield (
            f"the search ended after {search['generations']} generations, before its candidates"
            " had become alike; more generations may find better"
        )
    if search.get("spread_settled") is False:
        generations = document["calibration"]["spread"]["generations"]
        yield (
            f"in {generations} generations the chains did not go through all that fits equally"
            " well: it may reach farther than these ranges; ask for more generations of 'spread'"
        )
    if search["failed"]:
        yield f"{search['failed']} of {search['candidates']} candidates could not be computed"


def _coverage(document: dict[str, Any]) -> Iterator[str]:
    share = coverage(document)
    if misfits(document):
        yield (
            "nothing fits: these misses are larger than errors of the tolerances' size explain; the"
            " model, a tolerance or the range of a parameter is not right"
        )
    elif share is not None:
        yield (
            "these are no confidence intervals: where tolerances are standard deviations of"
            " readings whose errors are independent, 'lowest to highest' has the true value"
            f" {_often(share)}"
        )


def _often(share: float) -> str:
    percent = 100.0 * share
    return f"in {percent:.0f} % of the cases" if percent < 99.5 else "nearly always"


def _pairs(correlation: dict[str, Any]) -> Iterator[str]:
    names, matrix = correlation["parameters"], correlation["matrix"]
    for i, j in combinations(range(len(names)), 2):
        if abs(matrix[j][i]) >= TOGETHER:
            yield (
                f"{names[i]} and {names[j]} make up for one another (correlation"
                f" {matrix[j][i]:.2f}): the targets fix one combination of them, not each"
            )


def _number(value: float | None) -> str:
    return "none" if value is None else f"{value:.5g}"
