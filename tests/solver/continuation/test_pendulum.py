"""Period doublings of a damped driven pendulum, beside those known."""

import pytest

from benchmarks.known_orbits import DOUBLINGS, followed, pendulum


def test_a_pendulum_doubles_and_doubles_again_where_it_is_known_to() -> None:
    job = {
        "scene": pendulum(),
        "parameter": "strength",
        "values": {"from": 1.06, "to": 1.081, "count": 40},
        "settle": 200,
        "doublings": 1,
        "tolerance": 1e-12,
    }
    once, twice = followed(job)
    (first,) = [one for one in once.special if one.label == "PD"]
    (second,) = [one for one in twice.special if one.label == "PD"]
    assert first.value == pytest.approx(DOUBLINGS[0], abs=1e-9)
    assert second.value == pytest.approx(DOUBLINGS[1], abs=2e-8)
    assert second.bound < 1e-6
