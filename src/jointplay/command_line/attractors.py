"""Attractors of a map of basins, as lines."""

from collections.abc import Iterator, Mapping
from typing import Any


def attractor_lines(found: Mapping[str, Any]) -> Iterator[str]:
    """Yield how often each attractor is reached, and how rough the boundary between basins is."""
    rows = found["attractors"]
    width = max((len(one["name"]) for one in rows), default=0)
    for one in rows:
        share = f"{100.0 * one['share']:.4g} +- {100.0 * one['share_error']:.2g} %"
        exponent = (
            ""
            if one["lyapunov"] is None
            else f", exponent {one['lyapunov']:.4g} +- {one['lyapunov_error'] or 0.0:.2g} 1/s"
        )
        yield f"attractor {one['name']:{width}}  {one['points']} points, {share}{exponent}"
    if (boundary := found["boundary"]) is not None:
        yield f"boundary  dimension {boundary['dimension']:.3f} +- {boundary['error']:.3f}"
