"""Power spectra: the power is all there, lines stand where they should."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from jointplay.solver.nonlinear.spectrum import flatness, power_spectrum, strongest_line
from tests.solver.nonlinear.textbook import LOGISTIC_4, logistic


@given(st.integers(8, 200), st.integers(0, 2**32), st.floats(1e-3, 1e3))
def test_the_power_of_a_periodogram_is_the_variance(count: int, seed: int, interval: float) -> None:
    series = 3.0 + np.random.default_rng(seed).standard_normal((count, 2)) * [1.0, 1e3]
    spectrum = power_spectrum(series, interval)
    power = spectrum.density.sum(axis=0) * spectrum.resolution
    assert power == pytest.approx(series.var(axis=0), rel=1e-10)
    assert spectrum.frequency[-1] <= 0.5 / interval * (1.0 + 1e-12)


def test_averaged_segments_hold_the_variance_of_noise() -> None:
    noise = 2.0 * np.random.default_rng(0).standard_normal(20_000)
    spectrum = power_spectrum(noise, segments=20)
    assert spectrum.density.sum() * spectrum.resolution == pytest.approx(4.0, rel=0.03)
    # a one-sided density of variance 4 over frequencies up to 1/2, scattering by 1/sqrt(20)
    assert np.median(spectrum.density) == pytest.approx(8.0, rel=0.05)


@pytest.mark.parametrize(("count", "segments"), [(100, 7), (96, 7), (210, 20), (64, 1)])
def test_as_many_windows_are_averaged_as_were_asked_for(count: int, segments: int) -> None:
    series = np.random.default_rng(1).standard_normal(count)
    length = 2 * count // (segments + 1)
    window = 0.5 - 0.5 * np.cos(2.0 * math.pi * np.arange(length) / length)
    window = window if segments > 1 else np.ones(length)
    pieces = [series[k * (length // 2) :][:length] for k in range(segments)]
    powers = [np.abs(np.fft.rfft(window * (piece - piece.mean()))) ** 2 for piece in pieces]
    expected = 2.0 * np.mean(powers, axis=0) / (window**2).sum()
    found = power_spectrum(series, segments=segments).density
    np.testing.assert_allclose(found[1:-1], expected[1:-1], rtol=1e-9)


@pytest.mark.parametrize("interval", [1.0, 0.02])
@pytest.mark.parametrize("segments", [1, 4])
def test_a_sine_is_a_line_of_half_its_amplitude_squared(interval: float, segments: int) -> None:
    frequency = 0.125 / interval
    series = 5.0 + 3.0 * np.sin(2.0 * math.pi * frequency * interval * np.arange(1024.0))
    spectrum = power_spectrum(series, interval, segments)
    found, share = strongest_line(spectrum)
    assert found == pytest.approx(frequency, abs=spectrum.resolution)
    assert share > 0.95
    assert spectrum.density.sum() * spectrum.resolution == pytest.approx(4.5, rel=1e-3)


def test_a_period_shows_as_lines_and_chaos_as_a_continuum() -> None:
    regular = power_spectrum(logistic(3.5).orbit(1024, 500))
    chaotic = power_spectrum(LOGISTIC_4.orbit(1024))
    assert strongest_line(regular) == (0.5, pytest.approx(0.9, abs=0.1))
    assert flatness(regular) < 0.01
    # the logistic map at r = 4 has no correlations: white; exp(-Euler's constant) = 0.56
    assert flatness(chaotic) == pytest.approx(0.56, abs=0.05)
    assert strongest_line(chaotic)[1] < 0.1


def test_columns_count_alike_whatever_their_unit() -> None:
    slow, fast = (np.sin(2.0 * math.pi * f * np.arange(512.0)) for f in (0.125, 0.25))
    series = np.column_stack([1e-6 * fast, slow, 1e-6 * fast])
    assert strongest_line(power_spectrum(series))[0] == 0.25


def test_a_constant_has_no_line() -> None:
    spectrum = power_spectrum(np.ones(64))
    assert strongest_line(spectrum) == (0.0, 0.0)
    assert flatness(spectrum) == 0.0


@pytest.mark.parametrize(
    ("count", "interval", "segments"), [(7, 1.0, 1), (64, 0.0, 1), (64, 1.0, 0), (64, 1.0, 32)]
)
def test_bad_input_is_refused(count: int, interval: float, segments: int) -> None:
    with pytest.raises(ValueError, match="positive interval and eight samples"):
        power_spectrum(np.arange(float(count)), interval, segments)
