"""Eigenvalues of a small real matrix, whose last bits do not depend on the processor.

Hessenberg form by elimination, then the QR method with two shifts at once: `elmhes` and `hqr` of
Wilkinson and Reinsch 1971, Handbook for Automatic Computation II, contributions 13 and 14, behind
`balance` of contribution 11. All is plain arithmetic of real numbers and square roots.
"""

import math
from collections.abc import Iterator

from numpy.linalg import LinAlgError

from jointplay.records.arrays import Floats

Matrix = list[list[float]]
RADIX = 2.0
SMALLEST = 2.0**-52
MOST_ROUNDS = 60
"""Until one eigenvalue or pair is found."""
UNUSUAL = 10
"""Rounds after each of which the shift is another, that it may not go round for ever."""


def eigenvalues(matrix: Floats) -> list[complex]:
    """Return the eigenvalues of a matrix (n, n), n of them, in no order.

    LinAlgError: they were not found.
    """
    a: Matrix = matrix.tolist()
    if not all(math.isfinite(one) for row in a for one in row):
        raise LinAlgError("the matrix has numbers that are not finite")
    _balance(a)
    _eliminate(a)
    return list(_found(a))


def _balance(a: Matrix) -> None:
    """Make sums of rows and columns alike by powers of two."""
    size, again = len(a), True
    while again:
        again = False
        for i in range(size):
            column = sum(abs(a[j][i]) for j in range(size) if j != i)
            row = sum(abs(a[i][j]) for j in range(size) if j != i)
            if column == 0.0 or row == 0.0:
                continue
            factor, scaled = 1.0, column
            while scaled < row / RADIX:
                factor, scaled = factor * RADIX, scaled * RADIX * RADIX
            while scaled >= row * RADIX:
                factor, scaled = factor / RADIX, scaled / (RADIX * RADIX)
            if scaled + row < 0.95 * (column + row) * factor:
                again = True
                a[i] = [one / factor for one in a[i]]
                for j in range(size):
                    a[j][i] *= factor


def _eliminate(a: Matrix) -> None:
    """Bring a matrix to Hessenberg form: zeros below the line beneath the diagonal."""
    size = len(a)
    for m in range(1, size - 1):
        pivot = max(range(m, size), key=lambda i: abs(a[i][m - 1]))
        if a[pivot][m - 1] == 0.0:
            continue
        a[pivot], a[m] = a[m], a[pivot]
        for row in a:
            row[pivot], row[m] = row[m], row[pivot]
        for i in range(m + 1, size):
            share = a[i][m - 1] / a[m][m - 1]
            if share == 0.0:
                continue
            for j in range(size):
                a[i][j] -= share * a[m][j]
            for row in a:
                row[m] += share * row[i]
            a[i][m - 1] = 0.0


def _found(a: Matrix) -> Iterator[complex]:
    """Yield eigenvalues of a matrix in Hessenberg form, the last first."""
    norm = sum(abs(one) for row in a for one in row)
    last, shifted, rounds = len(a) - 1, 0.0, 0
    while last >= 0:
        low = _split(a, last, norm)
        if low == last:
            yield complex(a[last][last] + shifted)
            last, rounds = last - 1, 0
        elif low == last - 1:
            yield from _pair(a, last, shifted)
            last, rounds = last - 2, 0
        else:
            if rounds == MOST_ROUNDS:
                raise LinAlgError("the QR method does not converge")
            x, y, w = _shifts(a, last)
            if rounds and rounds % UNUSUAL == 0:
                shifted += x
                for i in range(last + 1):
                    a[i][i] -= x
                size = abs(a[last][last - 1]) + abs(a[last - 1][last - 2])
                x = y = 0.75 * size
                w = -0.4375 * size * size
            rounds += 1
            _sweep(a, low, last, (x, y, w))


def _split(a: Matrix, last: int, norm: float) -> int:
    """Return the first row of the block at the end that does not fall apart."""
    for row in range(last, 0, -1):
        size = abs(a[row - 1][row - 1]) + abs(a[row][row])
        if abs(a[row][row - 1]) <= SMALLEST * (size or norm):
            a[row][row - 1] = 0.0
            return row
    return 0


def _shifts(a: Matrix, last: int) -> tuple[float, float, float]:
    return a[last][last], a[last - 1][last - 1], a[last][last - 1] * a[last - 1][last]


def _pair(a: Matrix, last: int, shifted: float) -> Iterator[complex]:
    """Yield both eigenvalues of the block of two at the end."""
    x, y, w = _shifts(a, last)
    half = 0.5 * (y - x)
    square = half * half + w
    root = math.sqrt(abs(square))
    x += shifted
    if square < 0.0:
        yield complex(x + half, root)
        yield complex(x + half, -root)
        return
    far = half + (root if half >= 0.0 else -root)
    yield complex(x + far)
    yield complex(x - w / far if far else x)


def _sweep(a: Matrix, low: int, last: int, shifts: tuple[float, float, float]) -> None:
    """Do a round of the QR method with two shifts on the block low..last."""
    m, p, q, r = _begin(a, low, last, shifts)
    for i in range(m + 2, last + 1):
        a[i][i - 2] = 0.0
        if i > m + 2:
            a[i][i - 3] = 0.0
    for k in range(m, last):
        third = k < last - 1
        size = 1.0
        if k > m:
            p, q, r = a[k][k - 1], a[k + 1][k - 1], a[k + 2][k - 1] if third else 0.0
            size = abs(p) + abs(q) + abs(r)
            if size == 0.0:
                continue
            p, q, r = p / size, q / size, r / size
        length = math.sqrt(p * p + q * q + r * r)
        length = length if p >= 0.0 else -length
        if length == 0.0:
            continue
        if k > m:
            a[k][k - 1] = -length * size
        elif low != m:
            a[k][k - 1] = -a[k][k - 1]
        _reflect(a, (low, last, k), (p, q, r), length)


def _reflect(
    a: Matrix, at: tuple[int, int, int], vector: tuple[float, float, float], length: float
) -> None:
    """Reflect two or three rows, then as many columns, of the block low..last from k on."""
    low, last, k = at
    p, q, r = vector
    third = k < last - 1
    p += length
    x, y, z = p / length, q / length, r / length
    q, r = q / p, r / p
    for j in range(k, last + 1):
        share = a[k][j] + q * a[k + 1][j]
        if third:
            share += r * a[k + 2][j]
            a[k + 2][j] -= share * z
        a[k + 1][j] -= share * y
        a[k][j] -= share * x
    for i in range(low, min(last, k + 3) + 1):
        row = a[i]
        share = x * row[k] + y * row[k + 1]
        if third:
            share += z * row[k + 2]
            row[k + 2] -= share * r
        row[k + 1] -= share * q
        row[k] -= share


def _begin(
    a: Matrix, low: int, last: int, shifts: tuple[float, float, float]
) -> tuple[int, float, float, float]:
    """Return where a round may begin, and its first column there."""
    x, y, w = shifts
    m = last - 2
    while True:
        z = a[m][m]
        r, s = x - z, y - z
        p = (r * s - w) / a[m + 1][m] + a[m][m + 1]
        q = a[m + 1][m + 1] - z - r - s
        r = a[m + 2][m + 1]
        size = abs(p) + abs(q) + abs(r)
        p, q, r = p / size, q / size, r / size
        if m == low:
            return m, p, q, r
        small = abs(a[m][m - 1]) * (abs(q) + abs(r))
        large = abs(p) * (abs(a[m - 1][m - 1]) + abs(z) + abs(a[m + 1][m + 1]))
        if small <= SMALLEST * large:
            return m, p, q, r
        m -= 1
