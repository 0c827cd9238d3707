"""Numbers in equal ratios, against fifty digits."""

from decimal import Decimal, localcontext

import numpy as np
import pytest

from jointplay.solver.quantities.equal_ratios import equal_ratios


@pytest.mark.parametrize(
    ("start", "stop", "count"),
    [
        (1e-4, 1e-3, 5),
        (1e-3, 1e-4, 97),
        (-0.2, -7.0, 31),
        (1e-10, 1e10, 2001),
        (3e-200, 5e200, 17),
        (2.0, 3.0, 2),
        (1e-300, 1.7e308, 3),
        (1.7e308, 1e-300, 18),
        (7.0, 7.000000000001, 300),
    ],
)
def test_equal_ratios_are_those_of_fifty_digits(start: float, stop: float, count: int) -> None:
    found = equal_ratios(start, stop, count)
    assert (found[0], found[-1], len(found)) == (start, stop, count)
    with localcontext() as context:
        context.prec = 50
        first, ratio = Decimal(repr(start)), Decimal(repr(stop)) / Decimal(repr(start))
        exact = [first * ratio ** (Decimal(k) / Decimal(count - 1)) for k in range(count)]
        misses = [float(Decimal(float(x)) - y) for x, y in zip(found, exact, strict=True)]
    assert (np.abs(misses) <= 0.5001 * np.spacing(np.abs(found))).all()
    assert (np.diff(np.abs(found)) * np.sign(abs(stop) - abs(start)) > 0.0).all()


def test_decades_are_those_that_are_written() -> None:
    assert equal_ratios(1e-6, 1e-2, 5).tolist() == [1e-6, 1e-5, 1e-4, 1e-3, 1e-2]
    assert equal_ratios(-1e300, -1e-300, 7).tolist() == [
        *(-1e300, -1e200, -1e100, -1.0, -1e-100, -1e-200, -1e-300)
    ]


def test_one_number_is_the_first() -> None:
    assert equal_ratios(5.0, 5.0, 1).tolist() == [5.0]
