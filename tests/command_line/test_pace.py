"""Steps a second and the time that is left."""

import pytest

from jointplay.progress import Pace, duration


class Clock:
    now = 0.0

    def __call__(self):
        return self.now


def test_the_time_left_follows_from_the_pace_since_it_began():
    clock = Clock()
    pace = Pace(clock)
    for now, fraction, left in ((0, 0.0, None), (50, 0.0, None), (52, 0.2, 8.0), (55, 0.5, 5.0)):
        clock.now = now  # it waited for 50 s: they say nothing about its pace
        pace.saw(fraction)
        assert pace.seconds_left(fraction) == (None if left is None else pytest.approx(left))
    pace.saw(0.0)  # a lost worker: it begins anew
    assert pace.seconds_left(0.0) is None
    clock.now = 57
    pace.saw(0.25)
    assert pace.seconds_left(0.25) == pytest.approx(6.0)


def test_steps_a_second_are_those_of_the_last_reports():
    clock = Clock()
    pace = Pace(clock)
    assert pace.steps_per_second is None
    for now, steps in ((1.0, 0), (2.0, 1000), (2.5, 1000), (3.0, 4000), (4.0, None)):
        clock.now = now
        pace.saw(0.5, steps)
    assert pace.steps_per_second == 3000.0


@pytest.mark.parametrize(
    ("seconds", "words"),
    [
        (0.4, "0 s"),
        (59.4, "59 s"),
        (61, "1 min 01 s"),
        (3661, "1 h 01 min"),
        (90_000, "25 h 00 min"),
    ],
)
def test_durations_are_read_easily(seconds, words):
    assert duration(seconds) == words
