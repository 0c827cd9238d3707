"""Kinds of error bars, and that bars of positions hold between instants, too."""

import numpy as np
import pytest

from benchmarks.lies.run import Finished, finish
from jointplay.solver.runs.certificate.kinds import FORCE, MEANINGS, POSITION, PRESCRIBED, SPEED

BETWEEN = 16
"""Samples from an instant to the next."""


def finished(**job) -> Finished:
    found = finish({"kind": "simulate", **job})
    assert isinstance(found, Finished)
    return found


def test_a_channel_says_of_which_kind_its_bar_is() -> None:
    run = finished(scene={"preset": "slider-crank"}, duration=0.004)
    assert run.certificate is not None
    kinds = dict(zip(run.names, run.certificate.facts["kinds"], strict=True))
    expected = {
        "slider.x": POSITION,
        "P.penetration": POSITION,
        "slider.vx": SPEED,
        "energy.kinetic": SPEED,
        "slider.ax": FORCE,
        "P.normal_force": FORCE,
        "motor.torque": FORCE,
        "crank.omega": PRESCRIBED,
    }
    assert {name: kinds[name] for name in expected} == expected
    assert set(run.certificate.facts["bars"]) == set(MEANINGS)


@pytest.mark.parametrize("preset", ["bouncing-journal", "slider-crank"])
def test_bars_of_positions_hold_between_instants(preset: str) -> None:
    duration = {"bouncing-journal": 0.3, "slider-crank": 0.01}[preset]
    job = {"scene": {"preset": preset}, "duration": duration}
    certificate = finished(**job).certificate
    assert certificate is not None
    step = float(certificate.time[1]) / BETWEEN
    values, truth = (
        finished(**job, tolerance=tolerance, output_step=step, certificate=False)
        for tolerance in (1e-6, 1e-12)
    )
    end = np.searchsorted(certificate.time, certificate.facts["horizon"])
    assert end > 10
    inside = values.time[: 1 + round(certificate.time[end] / step)]
    after = np.searchsorted(certificate.time, inside - 0.5 * step)
    bar = np.maximum(certificate.error[after], certificate.error[np.maximum(after - 1, 0)])
    error = np.abs(values.samples - truth.samples)[: len(inside)]
    steady = np.array(certificate.facts["kinds"]) == POSITION
    # 1e-12 m or rad: what the finer run is off by itself
    assert (error <= bar + 1e-12)[:, steady].all()
