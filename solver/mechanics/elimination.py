"""Solves symmetric systems written out in scalars, keeping zeros out."""

from collections.abc import Mapping, Sequence

from jointplay.solver.quantities.scalars import Scalar, select_positive

Matrix = Mapping[tuple[int, int], Scalar]
"""Non-zero entries (i, j) of a symmetric matrix; either triangle may be given."""

DEPENDENT = 1e-13
"""Share of the diagonal's sum below which a pivot is rounding."""


def is_zero(value: Scalar) -> bool:
    """Tell whether a value is zero whatever the state: such entries are left out."""
    return isinstance(value, float) and value == 0.0


def solve_symmetric(
    matrix: Matrix, rights: Sequence[Sequence[Scalar]], floors: Sequence[Scalar] = ()
) -> list[list[Scalar]]:
    """Solve A x = b for each b by elimination in order of minimum degree.

    A : (n, n) symmetric positive definite, b : (n,). A tree fills in nothing: for a serial or
    branching chain this is the Schur elimination of the coordinates that do not couple. Divisions
    take long, so few wait for one another: among unknowns of the same degree one comes first whose
    pivot waits for fewer others, and the last two unknowns are solved for together. With `floors`,
    (n,), each has a pivot, and an unknown whose pivot is not above its floor is 0.
    """
    n = len(rights[0])
    rows: list[dict[int, Scalar]] = [{} for _ in range(n)]
    for (i, j), value in matrix.items():
        if not is_zero(value):
            rows[i][j] = value
            rows[j][i] = value
    reduced = [list(right) for right in rights]
    order: list[int] = []
    pivots: dict[int, Scalar] = {}
    factors: dict[int, dict[int, Scalar]] = {}
    waits = [0] * n
    remaining = set(range(n))
    while len(remaining) > (0 if floors else 2):
        k = min(remaining, key=lambda i: (len(rows[i]), waits[i], i))
        remaining.discard(k)
        order.append(k)
        pivot = rows[k].get(k, 0.0) if floors else rows[k][k]
        pivots[k] = _inverse(pivot, floors[k]) if floors else 1.0 / pivot
        neighbours = sorted(j for j in rows[k] if j in remaining)
        factors[k] = {j: rows[k][j] for j in neighbours}
        scaled = {j: rows[k][j] * pivots[k] for j in neighbours}
        for i in neighbours:
            waits[i] = max(waits[i], waits[k] + 1)
            for j in neighbours:
                if j > i:
                    continue
                update = scaled[i] * rows[k][j]
                value = rows[i][j] - update if j in rows[i] else -update
                rows[i][j] = value
                rows[j][i] = value
            for b in reduced:
                if not is_zero(b[k]):
                    b[i] = b[i] - scaled[i] * b[k]
            rows[i].pop(k, None)
    last = sorted(remaining)
    return [_substituted(b, _last_ones(rows, last, b), order, pivots, factors) for b in reduced]


def _last_ones(
    rows: Sequence[Mapping[int, Scalar]], last: Sequence[int], right: Sequence[Scalar]
) -> list[Scalar]:
    """Return x, (n,), of which the last one or two unknowns are solved for: by determinants."""
    x: list[Scalar] = [0.0] * len(right)
    if len(last) == 2 and last[1] in rows[last[0]]:
        (i, j), coupling = last, rows[last[0]][last[1]]
        inverse = 1.0 / (rows[i][i] * rows[j][j] - coupling * coupling)
        if not (is_zero(right[i]) and is_zero(right[j])):
            x[i] = (rows[j][j] * right[i] - coupling * right[j]) * inverse
            x[j] = (rows[i][i] * right[j] - coupling * right[i]) * inverse
    else:
        for k in last:
            x[k] = right[k] if is_zero(right[k]) else right[k] * (1.0 / rows[k][k])
    return x


def _substituted(
    reduced: Sequence[Scalar],
    x: list[Scalar],
    order: Sequence[int],
    pivots: Mapping[int, Scalar],
    factors: Mapping[int, Mapping[int, Scalar]],
) -> list[Scalar]:
    for k in reversed(order):
        known = reduced[k]
        for j, factor in factors[k].items():
            if not is_zero(x[j]):
                known = known - factor * x[j]
        x[k] = known if is_zero(known) else known * pivots[k]
    return x


def solve_semidefinite(
    matrix: Matrix, right: Sequence[Scalar], kinds: Sequence[str]
) -> list[Scalar]:
    """Solve A x = b where A, (n, n), is symmetric and may be singular, b within its range.

    An unknown is 0 where nothing but rounding is left of its pivot: what its equation says then
    follows from the others. That is measured against the diagonal of the rows of the same kind,
    which have the same unit.
    """
    entries = {index: value for index, value in matrix.items() if not is_zero(value)}
    sums: dict[str, Scalar] = {}
    for i, kind in enumerate(kinds):
        sums[kind] = sums.get(kind, 0.0) + entries.get((i, i), 0.0)
    floors = [DEPENDENT * sums[kind] for kind in kinds]
    [x] = solve_symmetric(entries, [right], floors)
    return x


def _inverse(pivot: Scalar, floor: Scalar) -> Scalar:
    """Return 1 / pivot, or 0 where it is not above the floor."""
    beyond = pivot - floor
    return select_positive(beyond, 1.0 / select_positive(beyond, pivot, 1.0), 0.0)
