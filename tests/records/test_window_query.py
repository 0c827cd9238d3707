"""Ends of a window: what is none, and which end is to be changed."""

import math

import pytest

from jointplay.records.window_query import wrong_end


@pytest.mark.parametrize(
    ("start", "stop", "end", "sentence"),
    [
        (math.nan, None, "start", "start is not a number"),
        (0.0, math.nan, "stop", "stop is not a number"),
        (2.0, 1.0, "stop", r"stop \(1 s\) is before start \(2 s\); swap them"),
    ],
)
def test_what_is_no_window_is_said_of_the_end_that_is_wrong(start, stop, end, sentence):
    found = wrong_end(start, stop)
    assert found is not None
    assert found[0] == end
    with pytest.raises(ValueError, match=f"^{sentence}"):
        raise ValueError(found[1])


@pytest.mark.parametrize(
    "ends", [(None, None), (1.0, None), (None, 1.0), (1.0, 1.0), (-math.inf, 2.0)]
)
def test_a_window_may_be_open_or_a_moment(ends):
    assert wrong_end(*ends) is None
