"""Error bars that were lies once."""

import pytest

from benchmarks.lies.named import companions, friction
from benchmarks.lies.named.lie import Lie

BARS = (*friction.BARS, *companions.LIES)


@pytest.mark.parametrize("lie", BARS, ids=[lie.name for lie in BARS])
def test_what_was_a_lie_is_one_no_more(lie: Lie) -> None:
    found = lie.judge()
    assert found.true, found.said
