"""Time as whole periods plus local time, so that period 10 000 is as sharp as the first."""

from solver.jit import kernel

SPLITTER = 134217729.0  # 2^27 + 1 (Dekker 1971)


@kernel()
def product_difference(a: float, b: float, c: float, d: float) -> float:
    """Return a * b - c * d with the rounding of both products taken into account."""
    first, second = a * b, c * d
    return (first - second) + (_rounding(a, b, first) - _rounding(c, d, second))


@kernel()
def _rounding(a: float, b: float, product: float) -> float:
    high_a = SPLITTER * a - (SPLITTER * a - a)
    high_b = SPLITTER * b - (SPLITTER * b - b)
    low_a, low_b = a - high_a, b - high_b
    return low_a * low_b - (((product - high_a * high_b) - low_a * high_b) - high_a * low_b)
