"""Error bars that were lies once."""

import pytest

from benchmarks.lies.named import companions, friction
from benchmarks.lies.named.lie import Lie

BARS = (*friction.BARS, *companions.LIES)
COMPILES_LONG = "press as a draft, its bars"


@pytest.mark.parametrize(
    "lie",
    [
        pytest.param(lie, id=lie.name, marks=[pytest.mark.long] * (lie.name == COMPILES_LONG))
        for lie in BARS
    ],
)
def test_what_was_a_lie_is_one_no_more(lie: Lie) -> None:
    found = lie.judge()
    assert found.true, found.said
