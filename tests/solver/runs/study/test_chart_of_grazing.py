"""A chart of the impact oscillator beside closed forms of where impacts begin and end.

With x'' + c x' + k x = A k cos(w t) and a stop at d, the motion without impacts grazes the stop
where A k |H| = d, H = 1 / (k - w^2 + i c w). For a rigid stop of restitution e the orbit of one
impact a period exists for amplitudes from its fold on; the flow F over a period T gives it:
u = inv([[1 - F11, F12], [-F21, F22 - 1]]) [-e F12, -e F22 - 1] for an impact at unit speed, and
the fold where A k |H| = d (|u2| / w) / sqrt(u1^2 + (u2 / w)^2).
"""

import numpy as np
import pytest

from jointplay.local import run

STIFFNESS, DAMPING, GAP, RESTITUTION = 400.0, 2.0, 0.01, 0.8  # N/m, N s/m, m: of the preset
SPEEDS, AMPLITUDES = (24.0, 34.0, 9), (5e-4, 1.25e-2, 17)


def grazing(speed):
    """Return the amplitude, m, from which on the motion without impacts reaches the stop."""
    response = 1.0 / abs(STIFFNESS - speed**2 + 1j * DAMPING * speed)
    return GAP / (STIFFNESS * response)


def fold(speed):
    """Return the amplitude, m, from which on there is an orbit of one impact a period."""
    decay = DAMPING / 2.0
    own, period = np.sqrt(STIFFNESS - decay**2), 2.0 * np.pi / speed
    s, c = np.sin(own * period), np.cos(own * period)
    flow = np.exp(-decay * period) * np.array(
        [[c + decay / own * s, s / own], [-STIFFNESS / own * s, c - decay / own * s]]
    )
    matrix = [[1.0 - flow[0, 0], flow[0, 1]], [-flow[1, 0], flow[1, 1] - 1.0]]
    side = [-RESTITUTION * flow[0, 1], -RESTITUTION * flow[1, 1] - 1.0]
    along, rate = np.linalg.solve(matrix, side)
    return grazing(speed) * abs(rate / speed) / np.hypot(along, rate / speed)


def test_the_closed_form_has_the_published_digits():
    """At an amplitude of 5 mm: Shaw and Holmes' oscillator, solved to ten digits."""
    assert grazing(14.21374738) == pytest.approx(0.005, rel=1e-8)
    assert grazing(24.37148714) == pytest.approx(0.005, rel=1e-8)
    assert fold(31.4314262200) == pytest.approx(0.005, rel=1e-8)


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
    for column, at in enumerate(speed):
        impacts = found.values[:, column]
        assert (impacts[amplitude > grazing(at) + pixel] > 0).all(), at
        assert (impacts[amplitude < fold(at) - pixel] == 0).all(), at


RANGE = ("from", "to", "count")
