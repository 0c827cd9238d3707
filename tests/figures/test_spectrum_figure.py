"""The spectrum figure: lines where they are, and as much power as the signal has."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest
from scipy import signal

from jointplay import figures
from jointplay.figures import Selection, page
from jointplay.figures.quantity import per_hertz
from jointplay.records.channel import Channel
from jointplay.records.run import Dataset

PERIOD = 0.5  # s, of the drivers


def sampled(samples, rate, **signals):
    """Channels over time [s], at so many samples a second."""
    time = np.arange(samples) / rate
    values = {name: signal(time) for name, signal in signals.items()}
    channels = [Channel(name, "m", name) for name in values]
    return Dataset({"scene": {}, "period": PERIOD}, channels, time, values)


def curve(source, name, **window):
    """Frequencies and power that are drawn of a channel, and the marked frequencies."""
    with page.style():
        figure = figures.draw(source, "spectrum", Selection((name,), **window))
    (axes,) = figure.axes
    line, *marked = axes.lines
    return *line.get_data(), [float(np.unique(one.get_xdata())[0]) for one in marked]


def test_a_line_stands_at_its_frequency_and_the_drivers_are_marked():
    source = sampled(8000, 100.0, tone=lambda t: 3.0 * np.sin(2.0 * np.pi * 7.0 * t))
    frequency, power, marked = curve(source, "tone")
    resolution = frequency[1] - frequency[0]
    assert frequency[power.argmax()] == pytest.approx(7.0, abs=resolution)
    assert marked == [1.0 / PERIOD]
    assert frequency[-1] == pytest.approx(50.0)  # half the sampling frequency
    # Parseval: the area is the variance, of a sine half its amplitude squared
    assert power.sum() * resolution == pytest.approx(4.5, rel=0.01)


def test_noise_is_flat_and_its_average_settles():
    noise = np.random.default_rng(1).normal(size=40_000)
    _, power, _ = curve(sampled(40_000, 100.0, noise=lambda t: noise), "noise")
    # the density of white noise of variance 1: one over half the sampling frequency; of 15
    # segments the ordinates scatter by about a quarter of it, their mean by far less
    assert power.mean() == pytest.approx(1.0 / 50.0, rel=0.05)
    assert np.std(power) < 0.4 / 50.0


def test_a_long_history_is_drawn_by_its_extremes():
    tone = 2.0 * np.pi * 1234.5
    source = sampled(400_000, 1e4, tone=lambda t: np.sin(tone * t) + 1e-6 * np.sin(40.0 * t))
    frequency, power, _ = curve(source, "tone")
    assert len(frequency) < 2500
    # a line is where it is, within half the resolution of 15 windows of 5 s, overlapping by half
    assert frequency[power.argmax()] == pytest.approx(1234.5, abs=0.5 / 5.0)


def test_the_axis_ends_where_its_curve_does():
    source = sampled(8000, 100.0, bell=lambda t: np.exp(-0.5 * (t - 40.0) ** 2))
    with page.style():
        (axes,) = figures.draw(source, "spectrum", Selection(("bell",))).axes
    frequency, power = axes.lines[0].get_data()
    shown = power >= axes.get_ylim()[0]
    assert axes.get_xlim()[1] == frequency[shown][-1] < 20.0  # half the sampling frequency is 50


def test_a_window_chooses_the_part_of_the_motion():
    source = sampled(
        8000, 100.0, tone=lambda t: np.sin(2.0 * np.pi * np.where(t < 40.0, 5.0, 20.0) * t)
    )
    for window, line in (({"stop": 39.9}, 5.0), ({"start": 40.0}, 20.0)):
        frequency, power, _ = curve(source, "tone", **window)
        assert frequency[power.argmax()] == pytest.approx(line, abs=0.3)


@pytest.mark.parametrize(("samples", "name"), [(20, "tone"), (500, "still"), (500, "lost")])
def test_what_has_no_spectrum_says_so(samples, name):
    source = sampled(samples, 100.0, tone=np.sin, still=np.ones_like, lost=lambda t: np.nan * t)
    with page.style():
        (axes,) = figures.draw(source, "spectrum", Selection((name,))).axes
    assert len(axes.lines) == 0
    assert [text.get_text() for text in axes.texts] == ["fewer than 32 samples, or no change"]


def test_what_was_not_computed_is_left_out():
    source = sampled(
        8000, 100.0, tone=lambda t: np.where(t < 40.0, np.sin(2.0 * np.pi * 7.0 * t), np.nan)
    )
    frequency, power, _ = curve(source, "tone")
    assert frequency[power.argmax()] == pytest.approx(7.0, abs=0.3)


def test_units_of_the_power_are_those_of_the_channel_squared_a_hertz():
    assert [per_hertz(unit) for unit in ("m", "m/s^2", "N m", "1")] == [
        "m²/Hz",
        "(m/s²)²/Hz",
        "(N·m)²/Hz",
        "1/Hz",
    ]


class Known(NamedTuple):
    """A trajectory that is known between samples: a tone of so many hertz."""

    reached: float
    tone: float

    @property
    def covered(self):
        return self.reached

    @property
    def values(self):
        return lambda _, times: Found(self.of(times)[:, None])

    def of(self, times):
        return np.sin(2.0 * np.pi * self.tone * times + 0.3)

    def extremes(self, _, edges):
        times = np.linspace(edges[:-1], edges[1:], 401)
        values = self.of(times)
        rows = np.arange(len(edges) - 1)
        ends = [(values[i, rows], times[i, rows]) for i in (values.argmin(0), values.argmax(0))]
        return Found(np.stack([one for end in ends for one in end], axis=1)[:, None])


class Sampled(Known):
    """The same, of which values are known at samples alone, and extremes between these."""

    @property
    def values(self):
        return lambda *_: Found(None, "No steps are kept.")


class Found(NamedTuple):
    values: np.ndarray
    refused: str = ""


@pytest.mark.parametrize("lasts", [1e-4, 1e-2, 10.0])
def test_lines_of_fast_and_slow_mechanisms_are_seen_alike(lasts):
    """Two hundred turns in a run, whether that lasts a tenth of a millisecond or seconds."""
    source = sampled(101, 100.0 / lasts, tone=np.sin)
    source = replace(source, trajectory=Known(lasts, 200.0 / lasts))
    frequency, power, _ = curve(source, "tone")
    assert frequency[power.argmax()] == pytest.approx(200.0 / lasts, rel=0.01)


@pytest.mark.parametrize(
    ("trajectory", "highest"),
    [(Sampled(10.0, 0.0), 10.0), (Known(1e4, 0.0), 2**17 / 2e4)],
    ids=["samples", "instants"],
)
@pytest.mark.parametrize(
    ("tone", "noted"),
    [
        (0.02, False),
        (0.5, False),
        (0.9, False),
        (1.3, True),
        (2.0, True),
        (3.01, True),
        (7.3, True),
    ],
)
def test_what_turns_twice_between_instants_is_said_to_appear_elsewhere(
    trajectory, highest, tone, noted
):
    """A tone, in highest frequencies: above one it is seen where none is."""
    source = sampled(201, 20.0, tone=lambda t: np.sin(2.0 * np.pi * tone * highest * t + 0.3))
    source = replace(source, trajectory=trajectory._replace(tone=tone * highest))
    if tone != 2.0:  # which is the same at all instants
        frequency, power, _ = curve(source, "tone")
        found = frequency[power.argmax()] / highest
        assert found == pytest.approx(abs(tone - 2.0 * round(tone / 2.0)), abs=0.02)
    with page.style():
        caption = figures.draw(source, "spectrum", Selection(("tone",))).get_supxlabel()
    told = "Of tone, motion is faster than these instants are apart" in caption.replace("\n", " ")
    assert told == noted


@pytest.mark.parametrize("samples", [4000, 4001, 777])
def test_the_power_is_that_of_welch(samples):
    noise = np.random.default_rng(2).normal(1.0, 1.0, samples)
    frequency, power, _ = curve(sampled(samples, 100.0, noise=lambda t: noise), "noise")
    length = round(100.0 / (frequency[1] - frequency[0]))
    there, expected = signal.welch(noise, 100.0, "hann", nperseg=length)
    np.testing.assert_allclose(frequency, there[1:], rtol=1e-12)
    # the same sums of up to 4000 numbers in another order
    np.testing.assert_allclose(power, expected[1:], rtol=1e-9)
