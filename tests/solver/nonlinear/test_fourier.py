"""Fourier transforms of our own, against SciPy's; Student's t, too."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import fft, signal, special

from jointplay.solver.nonlinear.fourier import inverse, transformed
from jointplay.solver.nonlinear.spectrum import power_spectrum
from jointplay.solver.nonlinear.student import student


@given(st.integers(1, 300), st.integers(0, 2**32))
def test_transforms_of_any_length_are_those_of_scipy(n: int, seed: int) -> None:
    z = np.random.default_rng(seed).standard_normal((2, n, 3))
    real, imaginary = transformed((z[0], z[1]))
    expected = fft.fft(z[0] + 1j * z[1], axis=0)
    assert real == pytest.approx(expected.real, abs=1e-11)
    assert imaginary == pytest.approx(expected.imag, abs=1e-11)


def test_an_inverse_leads_back() -> None:
    z = np.random.default_rng(0).standard_normal((2, 64, 2))
    real, imaginary = inverse(transformed((z[0], z[1])))
    assert real == pytest.approx(z[0], abs=1e-14)
    assert imaginary == pytest.approx(z[1], abs=1e-14)


@pytest.mark.parametrize("segments", [1, 2, 5])
@pytest.mark.parametrize("count", [97, 128])
def test_a_spectrum_is_that_of_welch(count: int, segments: int) -> None:
    series = 5.0 + np.random.default_rng(1).standard_normal((count, 2))
    window, length = "boxcar" if segments == 1 else "hann", 2 * count // (segments + 1)
    frequency, density = signal.welch(series, 4.0, window, nperseg=length, axis=0)
    found = power_spectrum(series, 0.25, segments)
    assert found.frequency == pytest.approx(frequency, rel=1e-13)
    assert found.density == pytest.approx(density, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("freedom", [1, 2, 3, 6, 7, 50, 199, 200, 201, 1000, 100_000])
def test_students_t_is_that_of_scipy(freedom: int) -> None:
    expected = float(special.stdtrit(freedom, special.ndtr(3.0)))
    assert student(freedom) == pytest.approx(expected, rel=1e-10)
