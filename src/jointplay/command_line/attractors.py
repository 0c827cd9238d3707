"""Attractors of many starts, as lines."""

from collections.abc import Iterator, Mapping
from typing import Any


def attractor_lines(found: Mapping[str, Any]) -> Iterator[str]:
    """Yield how often each attractor is reached, and how rough the boundary between basins is."""
    rows = found["attractors"]
    width = max((len(one["name"]) for one in rows), default=0)
    for one in rows:
        share = f"{100.0 * one['share']:.4g} ± {100.0 * one['share_error']:.2g} %"
        exponent = (
            ""
            if one["lyapunov"] is None
            else f", exponent {one['lyapunov']:.4g} ± {one['lyapunov_error'] or 0.0:.2g} 1/s"
        )
        points = "1 point" if one["points"] == 1 else f"{one['points']} points"
        yield f"attractor {one['name']:{width}}  {points}, {share}{exponent}"
    if (along := found["along"]) is not None:
        yield from _over_values(along, rows, width)
    if (boundary := found["boundary"]) is not None:
        yield f"boundary  dimension {boundary['dimension']:.3f} ± {boundary['error']:.3f}"


def _over_values(
    along: Mapping[str, Any], rows: list[Mapping[str, Any]], width: int
) -> Iterator[str]:
    unit = "" if along["unit"] == "1" else f" {along['unit']}"
    for index, value in enumerate(along["values"]):
        parts = [
            f"{one['name']:{width}} {100.0 * one['shares'][index]:.4g} ±"
            f" {100.0 * one['share_errors'][index]:.2g} %"
            for one in rows
            if one["shares"][index]
        ]
        yield f"{along['parameter']} = {value:.6g}{unit}  {', '.join(parts)}"
