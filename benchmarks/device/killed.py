"""A chart on a device, killed in its midst: the processor goes on, to the bytes of one whole.

A process of its own computes it.
"""

import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import cast

import jointplay
from benchmarks.device.charts import chart
from benchmarks.device.opened import opened
from jointplay.solver.kinds import Study, admit
from jointplay.worker.local import restart_points
from jointplay.worker.local.computing import compute
from jointplay.worker.local.folder import STORE

SIZE = 24, 40
"""Points along each axis, and revolutions of each."""
HERE = 5, 20
PARTS = "running/study/parts/*-a1*"
"""Restart points."""


def job(there: bool) -> Study:
    """Return the chart."""
    return cast(Study, admit(chart("slider-crank", *(SIZE if there else HERE), ("recurrence",))))


def report(there: bool) -> None:
    """Print how far it was, and whether the bytes are the same."""
    with tempfile.TemporaryDirectory() as name:
        cut, whole = Path(name) / "cut", Path(name) / "whole"
        cut.mkdir()
        begun = time.perf_counter()
        program = "from benchmarks.device.killed import main; main()"
        with subprocess.Popen([sys.executable, "-c", program, cut]) as process:
            while process.poll() is None and not any(cut.glob(PARTS)):
                time.sleep(0.01)
            process.kill()
        killed = time.perf_counter() - begun
        kept = len(list(cut.glob(PARTS)))
        jointplay.resume(cut, processes=1)
        jointplay.run(job(there).job, output=whole, processes=1)
        same = (cut / STORE).read_bytes() == (whole / STORE).read_bytes()
        print(
            f"killed after {killed:.1f} s with restart points of {kept} of"
            f" {len(job(there).blocks)} blocks; the processor went on:"
            f" {'the same bytes' if same else 'OTHER BYTES'}",
            flush=True,
        )
        if not (same and kept):
            raise SystemExit(1)


def main() -> None:
    """Compute the chart into a folder that is given, with restart points between all launches."""
    restart_points.PERIOD = restart_points._MOST_OVERHEAD = 0
    found = opened()
    study = job(found.there)
    compute(study, Path(sys.argv[1]), None, lambda *_: None, found.lanes)
