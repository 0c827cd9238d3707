"""Extremes of functions of time are found between the instants that were looked at."""

import numpy as np
import pytest

from jointplay.solver.quantities.extremes import refined_peaks


@pytest.mark.parametrize("beside_end", [0.05, 0.5, 0.95])
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_an_extreme_between_an_end_and_the_instant_beside_it_is_found(beside_end, sense):
    times = np.linspace(0.0, 1.0, 51)
    for at in (beside_end * times[1], 1.0 - beside_end * times[1]):

        def evaluate(found, at=at):
            return sense * np.cos(found - at)[:, None]

        peak = refined_peaks(["x"], evaluate, times, evaluate(times))["x"]
        value, time = (
            (peak.maximum, peak.maximum_time) if sense > 0 else (peak.minimum, peak.minimum_time)
        )
        assert value == pytest.approx(sense, abs=1e-14)
        assert time == pytest.approx(at, abs=1e-6)  # half of all digits: the value is flat there


def test_an_end_that_is_not_surpassed_is_the_extreme():
    times = np.linspace(0.0, 1.0, 51)

    def evaluate(found):
        return np.exp(found)[:, None]

    peak = refined_peaks(["x"], evaluate, times, evaluate(times))["x"]
    assert (peak.minimum, peak.minimum_time) == (1.0, 0.0)
    assert (peak.maximum, peak.maximum_time) == (np.exp(1.0), 1.0)


@pytest.mark.parametrize("beside", [0.0, 1e-9, 1e-6, 1e-4, 1e-2])
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_an_extreme_at_a_corner_is_found(beside, sense):
    """A distance of points that pass one another, beside a channel that has no corner."""
    times, at = np.linspace(0.0, 1.0, 51), 0.3217

    def evaluate(found):
        distance = np.hypot(np.sin(found - at), beside)
        return np.stack([-sense * distance, np.cos(found - at)], axis=1)

    peaks = refined_peaks(["x", "y"], evaluate, times, evaluate(times))
    x = peaks["x"]
    value, time = (x.maximum, x.maximum_time) if sense > 0 else (x.minimum, x.minimum_time)
    assert -sense * value == pytest.approx(beside, abs=1e-7)
    assert time == pytest.approx(at, abs=1e-6)
    assert peaks["y"].maximum == pytest.approx(1.0, abs=1e-14)


@pytest.mark.parametrize("sense", [1.0, -1.0])
@pytest.mark.parametrize(("first", "second"), [(0.2195, 0.6015), (0.0501, 0.62), (0.0501, 0.68)])
def test_the_highest_of_jumps_is_found_wherever_instants_are(sense, first, second):
    """Instants show the lower jump as the higher one, or are at a jump but for their rounding."""
    times, fall = np.linspace(0.0, 1.0, 51), 30.0

    def evaluate(found):
        saw = np.where(found > second, 1.01 - fall * (found - second), -fall * found)
        saw = np.where((found > first) & (found <= second), 1.0 - fall * (found - first), saw)
        return sense * saw[:, None]

    peak = refined_peaks(["x"], evaluate, times, evaluate(times))["x"]
    value, time = (
        (peak.maximum, peak.maximum_time) if sense > 0 else (peak.minimum, peak.minimum_time)
    )
    assert sense * value == pytest.approx(1.01, abs=1e-6)
    assert time == pytest.approx(second, abs=1e-7)
