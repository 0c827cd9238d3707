"""Angles that go round, within one turn: each place once."""

import numpy as np
import pytest

from jointplay.figures.turns import within_a_turn


@pytest.mark.parametrize("places", [2, 3, 4, 5, 6, 8])
@pytest.mark.parametrize("first", [0.0, -1.5, 0.25 * np.pi, np.pi])
def test_a_wheel_that_comes_to_a_few_places_is_at_each_once(places: int, first: float) -> None:
    noise = 1e-9 * np.random.default_rng(places).uniform(-1.0, 1.0, 60)
    angles = first + 2.0 * np.pi / places * np.arange(60) + noise
    found = within_a_turn(angles)
    assert np.ptp(found) < 2.0 * np.pi
    assert len(np.unique(np.round(found, 6) + 0.0)) == places
    np.testing.assert_allclose(np.exp(1j * found), np.exp(1j * angles), atol=1e-12)
