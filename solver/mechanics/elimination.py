"""Solves symmetric positive definite systems written out in scalars, keeping zeros out."""

from collections.abc import Mapping, Sequence

from jointplay.solver.quantities.scalars import Scalar

Matrix = Mapping[tuple[int, int], Scalar]
"""Non-zero entries (i, j) of a symmetric matrix; either triangle may be given."""


def solve_symmetric(matrix: Matrix, right: Sequence[Scalar]) -> list[Scalar]:
    """Solve A x = b by elimination in order of minimum degree, so that a tree fills in nothing.

    A : (n, n) symmetric positive definite, b : (n,). For a serial or branching chain this is the
    Schur elimination of the coordinates that do not couple.
    """
    n = len(right)
    rows: list[dict[int, Scalar]] = [{} for _ in range(n)]
    for (i, j), value in matrix.items():
        if not (isinstance(value, float) and value == 0.0):
            rows[i][j] = value
            rows[j][i] = value
    b = list(right)
    order: list[int] = []
    pivots: dict[int, Scalar] = {}
    factors: dict[int, dict[int, Scalar]] = {}
    remaining = set(range(n))
    while remaining:
        k = min(remaining, key=lambda i: (len(rows[i]), i))
        remaining.discard(k)
        order.append(k)
        pivots[k] = 1.0 / rows[k][k]
        neighbours = sorted(j for j in rows[k] if j in remaining)
        factors[k] = {j: rows[k][j] for j in neighbours}
        scaled = {j: rows[k][j] * pivots[k] for j in neighbours}
        for i in neighbours:
            for j in neighbours:
                if j > i:
                    continue
                update = scaled[i] * rows[k][j]
                value = rows[i][j] - update if j in rows[i] else -update
                rows[i][j] = value
                rows[j][i] = value
            b[i] = b[i] - scaled[i] * b[k]
            rows[i].pop(k, None)
    x: list[Scalar] = [0.0] * n
    for k in reversed(order):
        known = b[k]
        for j, factor in factors[k].items():
            known = known - factor * x[j]
        x[k] = known * pivots[k]
    return x
