"""Numbers of many points at once say what each of them says, or refuse."""

import math

import pytest

from jointplay.solver.quantities import scalars
from jointplay.solver.quantities.varied import Varied, together


def varied(*numbers: float) -> Varied:
    found = together(numbers)
    assert isinstance(found, Varied)
    return found


def test_a_number_that_all_points_have_is_that_number() -> None:
    assert together([2.5, 2.5]) == 2.5
    assert isinstance(together([2.5, 2.5]), float)
    assert varied(1.0, 2.0).tolist() == [1.0, 2.0]


def test_a_branch_is_taken_if_all_points_take_it() -> None:
    numbers = varied(1.0, 2.0)
    assert bool(numbers > 0.5)
    assert not bool(numbers > 2.5)
    assert max(numbers, 0.5) is numbers
    with pytest.raises(ValueError, match="differ"):
        bool(numbers > 1.5)
    with pytest.raises(ValueError, match="differ"):
        max(numbers, 1.5)


def test_what_takes_one_number_refuses_many() -> None:
    for function in (math.sqrt, float, math.isfinite, lambda x: round(x, 3)):
        with pytest.raises(TypeError):
            function(varied(1.0, 2.0))


def test_whole_numbers_are_rounded_as_of_one_number() -> None:
    numbers = (0.5, 1.5, 2.4, -2.5)
    assert round(varied(*numbers)).tolist() == [round(one) for one in numbers]


def test_sums_and_the_least_of_many_are_those_of_each() -> None:
    some = [varied(1e16, 3.0), 1.0, varied(-1e16, 5.0)]
    each = [(1e16, 1.0, -1e16), (3.0, 1.0, 5.0)]
    assert scalars.exact_sum(some).tolist() == [math.fsum(one) for one in each]
    assert scalars.least(some).tolist() == [min(one) for one in each]
    assert scalars.greatest(some).tolist() == [max(one) for one in each]
    assert scalars.exact_sum([]) == 0.0
