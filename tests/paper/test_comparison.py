"""Numbers of a row as readers see them."""

import pytest

from jointplay.paper.comparison import Cell, signed, small


@pytest.mark.parametrize(
    ("ratio", "grade"),
    [(1.019, "same"), (0.9, "close"), (1.4, "order"), (2.0, "far"), (0.4, "far"), (None, "")],
)
def test_a_cell_says_in_one_word_how_near_it_is(ratio, grade):
    assert Cell("", (), ratio).grade == grade


def test_zero_has_no_sign_and_others_have_a_typographic_one():
    assert signed(-0.0004, ".2f") == "0.00"
    assert signed(-0.012, ".2f") == "−0.01"
    assert signed(-1.5e-7, ".2g") == "−1.5e−07"


def test_what_nobody_would_notice_is_zero():
    assert small(-0.0004, 0.005) == "0"
    assert small(0.034, 0.005) == "0.034"
