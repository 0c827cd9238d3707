"""Impacts: contacts in joints with clearance, from onset to release."""

from typing import Final

import numpy as np

MEASURED: Final = {
    "onset": ("s", "time of impact onset"),
    "release": ("s", "time of release"),
    "approach_rate": ("m/s", "approach rate at onset"),
    "peak_force": ("N", "largest normal contact force"),
    "impulse": ("N s", "impulse of the normal contact force"),
}
"""Unit and meaning of the numbers of an impact; `release` is NaN while the contact lasts."""

IMPACT: Final = np.dtype([("joint", "<i4"), *((name, "<f8") for name in MEASURED)])
"""One contact: index of its pair, named after the joint, then the numbers of `MEASURED`."""
IMPACT_UNITS: Final = {name: unit for name, (unit, _) in MEASURED.items()}
