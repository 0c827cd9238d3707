"""Bits, rates, whole charts and a killed run: `python -m benchmarks device`, in four minutes.

Where there is no device, this processor does what its driver does, of fewer points.
"""

import tempfile
from pathlib import Path

from benchmarks.device import charts, killed, run
from benchmarks.device.opened import opened
from benchmarks.device.prepare import MECHANISMS, SIDE, prepare
from jointplay.solver.kernels.device.lanes import BLOCK

FEW = 4
"""Points along each axis, where there is no device."""


def main() -> None:
    """Print all of it."""
    found = opened()
    device = found.device
    print(
        f"{device.name}: {device.processors} multiprocessors, single precision {device.ratio} times"
        " as fast as double"
    )
    side = SIDE if found.there else FEW
    counts = (BLOCK * device.processors,) if found.there else (FEW * FEW,)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for mechanism in MECHANISMS:
            prepare(mechanism, folder, side, on_host=not found.there)
            given = run.Given(folder, mechanism)
            for variant in ("", "_constant"):
                run.measure(given, device, folder / mechanism, variant, counts)
    charts.rates(found)
    killed.report(found.there)
