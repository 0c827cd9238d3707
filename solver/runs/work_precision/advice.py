"""A sentence that recommends a method and a tolerance."""

from collections.abc import Iterable, Sequence

from jointplay.solver.runs.work_precision.plan import DEFAULT
from jointplay.solver.runs.work_precision.point import Point


def cheapest(points: Iterable[Point], error: float) -> Point | None:
    """Return the admitted run of fewest evaluations whose error is at most `error`."""
    able = [p for p in points if p.admitted and p.error is not None and p.error <= error]
    return min(able, key=lambda p: p.evaluations, default=None)


def advice(points: Sequence[Point], uncertainty: float) -> str:
    """Say what gives the error of the default, and one a hundred times smaller, at least cost.

    `uncertainty` : of the reference; no error below is known. Seconds do not count, so the same
    study gives the same sentence.
    """
    default = next((p for p in points if (p.method, p.tolerance) == DEFAULT), None)
    if default is None or default.error is None:
        return "The default did not come to the end of this run; ask for a tighter tolerance."
    if default.error <= uncertainty:
        return "The default is as accurate as the reference: there is nothing to choose."
    best = cheapest(points, default.error) or default
    if best.evaluations == default.evaluations:
        best = default
    first = (
        f"The default, {default.name}, makes an error of {default.error:.1e}"
        f" in {default.evaluations} evaluations"
    )
    if best == default:
        first += ", and nothing does it in fewer."
    else:
        first += f"; {best.name} does with {best.evaluations / default.evaluations:.0%} of them."
    finer = max(0.01 * default.error, 3.0 * uncertainty)
    then = cheapest(points, finer)
    if then is None:
        return first
    ratio = then.evaluations / default.evaluations
    return (
        f"{first} For an error below {finer:.1e} take {then.name}, at {ratio:.1f} times the cost."
    )
