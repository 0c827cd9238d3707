"""Differences of products without their rounding; on floats, on arrays and inside kernels."""

from typing import Any

SPLITTER = 134217729.0  # 2^27 + 1 (Dekker 1971)


def product_difference(a: Any, b: Any, c: Any, d: Any) -> Any:
    """Return a * b - c * d with the rounding of both products taken into account."""
    first, second = a * b, c * d
    high_a = SPLITTER * a - (SPLITTER * a - a)
    high_b = SPLITTER * b - (SPLITTER * b - b)
    low_a, low_b = a - high_a, b - high_b
    lost = low_a * low_b - (((first - high_a * high_b) - low_a * high_b) - high_a * low_b)
    high_c = SPLITTER * c - (SPLITTER * c - c)
    high_d = SPLITTER * d - (SPLITTER * d - d)
    low_c, low_d = c - high_c, d - high_d
    lost -= low_c * low_d - (((second - high_c * high_d) - low_c * high_d) - high_c * low_d)
    return (first - second) + lost
