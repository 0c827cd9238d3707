"""Histograms of certificates beside those of all samples of a settled motion."""

import math

import numpy as np
import pytest

from jointplay.solver.kinds import admit
from jointplay.solver.runs.dynamic_run import DynamicRun

PERIOD = 2.0 * math.pi / 28.0


@pytest.mark.parametrize("periods", [60, 64])
def test_shares_of_time_are_those_of_the_samples(periods: int) -> None:
    scene = {"preset": "impact-oscillator", "parameters": {"speed": 28.0}}
    duration = periods * PERIOD
    job = {"kind": "simulate", "scene": scene, "duration": duration, "output_step": PERIOD / 200}
    run = DynamicRun(admit(job | {"certificate": True, "channels": ["mass.x"]}))
    x = np.concatenate([piece.samples[:, 0] for piece in run.slices()])
    certificate = run.certificate()
    assert certificate is not None
    edges = certificate.edges[:, 0]
    true = np.histogram(x, edges)[0] / len(x)
    assert np.abs(certificate.share[:, 0] - true).max() < 0.03
