"""Charts of the impact oscillator beside closed forms of where impacts begin, end and double."""

import numpy as np
import pytest

from benchmarks.chart_curves import classes, distances, rows
from benchmarks.rigid_stop import doubling, fold, grazing
from jointplay.local import run

SPEEDS, AMPLITUDES = (24.0, 34.0, 9), (5e-4, 1.25e-2, 17)


def test_the_closed_form_has_the_published_digits():
    """At an amplitude of 5 mm: Shaw and Holmes' oscillator, solved to ten digits."""
    speeds = np.array([14.21374738, 24.37148714, 31.4314262200, 19.2111372427])
    of = [*grazing(speeds[:2]).amplitude, *fold(speeds[2:3]).amplitude]
    assert [*of, *doubling(speeds[3:]).amplitude] == pytest.approx([0.005] * 4, rel=1e-8)
    assert fold(speeds[2:3]).admissible.all()
    assert doubling(speeds[3:]).admissible.all()


def test_impacts_last_beyond_grazing_and_never_below_the_fold():
    """Within a pixel; a stop that gives moves the fold by 2e-3 at most."""
    job = run(
        {
            "kind": "chart",
            "scene": {"preset": "impact-oscillator"},
            "along": {"parameter": "speed", "values": dict(zip(RANGE, SPEEDS, strict=True))},
            "by": {"parameter": "amplitude", "values": dict(zip(RANGE, AMPLITUDES, strict=True))},
            "settle": 60,
            "record": 8,
            "tolerance": 1e-6,
            "indicators": ["recurrence"],
            "statistics": ["impacts"],
        },
        processes=2,
    )
    found = job.dataset["stop.impacts"].transpose("amplitude", "speed")
    amplitude, speed = found["amplitude"].values, found["speed"].values
    pixel = amplitude[1] - amplitude[0]
    touches, ends = grazing(speed).amplitude, fold(speed).amplitude
    for column, at in enumerate(speed):
        impacts = found.values[:, column]
        assert (impacts[amplitude > touches[column] + pixel] > 0).all(), at
        assert (impacts[amplitude < ends[column] - pixel] == 0).all(), at


RANGE = ("from", "to", "count")


@pytest.mark.parametrize(("direction", "curve"), [("forward", "grazing"), ("backward", "fold")])
def test_rows_that_follow_their_neighbours_change_within_a_pixel_of_a_curve(direction, curve):
    """Upwards impacts begin where motion without them grazes; downwards they end at the fold."""
    speeds = np.array([24.0, 27.0, 29.0])
    data = run(rows(60, speeds, direction), processes=1).dataset
    strikes, _ = classes(data)
    away = distances(curve, strikes, speeds, data["amplitude"].values)
    assert (away <= 1.0).all()
