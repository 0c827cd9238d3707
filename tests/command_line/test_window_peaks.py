"""Peaks of a window of samples, in closed form."""

from types import SimpleNamespace

import numpy as np
import pytest

from jointplay.client import Refused
from jointplay.client.window import ChannelSeries, Window
from jointplay.command_line.window_peaks import peaks_inside

TIME = np.linspace(0.0, 10.0, 100_001)
LEVEL = np.sin(TIME)
LEVEL[60_000:] = np.nan  # a run that ended early


def window(names, start=None, stop=None, points=None):
    """Give samples, or the extremes of spans at the ends of these, as a job does."""
    begin, end = start or 0.0, np.inf if stop is None else stop
    inside = (begin <= TIME) & (end >= TIME)
    time, values = TIME[inside], LEVEL[inside]
    exact = points is None or len(time) <= points
    if not exact:
        cut = np.array_split(np.arange(len(time)), points)
        with np.errstate(invalid="ignore"):
            pairs = [(values[one].min(), values[one].max()) for one in cut]
        time, values = time[[k for one in cut for k in one[[0, -1]]]], np.ravel(pairs)
    return Window(time, {names[0]: ChannelSeries("m", "", values)}, complete=False, exact=exact)


def refuse(*_window):
    raise Refused("the steps are not kept")


@pytest.fixture
def job():
    return SimpleNamespace(id="run", window=window, results=SimpleNamespace(peaks=refuse))


@pytest.mark.parametrize("spans", [7, 2000, 200_000])
def test_extremes_have_the_time_of_their_sample_beside_what_is_not_known(job, spans):
    peak = peaks_inside(job, ["level"], 0.5, None, spans)["level"]
    assert peak["maximum"] == pytest.approx(1.0, abs=1e-9)
    assert peak["maximum_time"] == pytest.approx(0.5 * np.pi, abs=1e-4)
    assert peak["minimum"] == pytest.approx(-1.0, abs=1e-9)
    assert peak["minimum_time"] == pytest.approx(1.5 * np.pi, abs=1e-4)


def test_of_a_window_in_which_nothing_is_known_there_is_no_extreme(job):
    peak = peaks_inside(job, ["level"], 7.0, 8.0, 10)["level"]
    assert np.isnan([peak[name] for name in ("minimum", "maximum", "maximum_time")]).all()
