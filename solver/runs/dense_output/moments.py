"""Instants as products of two numbers: the time of a sample is that sample, to the last bit."""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.runs.admission import Admission

ROUNDINGS = 4.0
"""Roundings by which a time may be off a sample's: times of windows are sums and products."""


def moments_of(admission: Admission, times: Floats) -> Floats:
    """Return instants (m, 2) of times (m,), s: the index of a sample and the output step, or 1.

    A run takes its samples at such products before they are rounded; a time alone would be up to
    a rounding off, and on the other side of a jump.
    """
    step, duration = float(admission.job["output_step"]), float(admission.job["duration"])
    index = np.rint(times / step)
    sampled = np.abs(index * step - times) <= ROUNDINGS * np.spacing(times)
    sampled &= (times < duration) & (index < admission.samples - 1)
    return np.column_stack([np.where(sampled, index, times), np.where(sampled, step, 1.0)])
