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


def test_what_it_takes_to_begin_is_no_pace():
    """A study of 8 s said `9 min left`: 6 s in which other processes began counted as its pace."""
    clock = Clock()
    pace = Pace(clock)
    seen = [(2.3, 0.0), (3.2, 0.0014), (9.3, 0.02)] + [
        (9.4 + t / 10, 0.04 * t) for t in range(2, 25)
    ]
    told = []
    for clock.now, fraction in seen:
        pace.saw(fraction)
        told.append(pace.seconds_left(fraction))
    assert told[:2] == [None, None]
    for (_, fraction), left in zip(seen[6:], told[6:], strict=True):
        assert left == pytest.approx((1.0 - fraction) / 0.4, abs=0.6)


def test_a_beginning_of_tiny_steps_is_no_pace():
    """A run of 15 s whose first contact chatters said `42 h 07 min left`."""
    clock = Clock()
    pace = Pace(clock)
    for clock.now, fraction in [(0, 0.0), (150, 5.439e-3), (152, 5.44e-3), (154, 5.444e-3)]:
        pace.saw(fraction)
        assert pace.seconds_left(fraction) is None
    for clock.now, fraction in [(155, 0.0055), (156, 0.1), (157, 0.2), (158, 0.3)]:
        pace.saw(fraction)
    assert pace.seconds_left(0.3) == pytest.approx(7.0)


def test_something_slow_tells_its_time_at_once():
    clock = Clock()
    pace = Pace(clock)
    for now in range(100, 1100):  # a hundred thousandth a second
        clock.now = float(now)
        pace.saw(1e-5 * (now - 99))
    assert pace.seconds_left(1e-2) == pytest.approx(0.99e5, rel=1e-6)


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
