"""`python -m jointplay.worker.warm`: compile the kernels of presets, while an image is built.

Of all that need no parameters, unless some are named. With ``--check`` nothing may be left to
compile: it proves that the kernels of an image are used by the processor they run on.
"""

import argparse
import sys
import time
from typing import cast

import numpy as np

from jointplay.solver.kernels.cache import cache_folder
from jointplay.solver.kernels.emit.tangents import compile_tangents
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.runs.dense_output.columns import method_of
from jointplay.solver.runs.dense_output.replay import Replay
from jointplay.solver.runs.simulate import Simulation
from jointplay.solver.scene import presets


def warm(name: str) -> float:
    """Compile or load a preset's kernels, those of exponents too. Returns the seconds."""
    began = time.perf_counter()
    job = {"kind": "simulate", "scene": {"preset": name}, "duration": 1e-3}
    admission = cast("Admission", admit(job))
    simulation = Simulation(admission)
    steps = np.concatenate([piece.steps for piece in simulation.slices()])
    if len(steps):  # windows are computed by code of their own
        replay = Replay(admission, method_of(steps[0, -1]))
        rows, names = np.ascontiguousarray(steps[:, :-1]), [admission.channels[0].name]
        replay.mismatch(rows)
        replay.channels(names, rows, np.array([[0.0, 1.0]]))
        replay.extremes(names, rows, np.array([0.0, 1e-3]), np.zeros(1))
    structure = admission.scene, admission.job["formulation"], admission.method
    compile_tangents(ready_kernel(*structure))
    ready_kernel(*structure, alone=True)  # of simulations without certificate
    return time.perf_counter() - began


def without_parameters() -> list[str]:
    """Return the names of the presets of which nothing must be given."""
    return [
        name
        for name in presets.names()
        if not any(one.get("required") for one in presets.document(name)["parameters"].values())
    ]


def main() -> int:
    """Warm presets and say how long each took. Returns 3 if a check finds something compiled."""
    parser = argparse.ArgumentParser(prog="python -m jointplay.worker.warm", description=__doc__)
    parser.add_argument("--check", action="store_true", help="fail if anything is compiled")
    parser.add_argument("preset", nargs="*", help="names of presets")
    arguments = parser.parse_args()
    before = _compiled()
    for name in arguments.preset or without_parameters():
        sys.stdout.write(f"{name}: {warm(name):.1f} s\n")
    new = _compiled() - before
    if arguments.check and new:
        sys.stdout.write(f"{len(new)} modules had to be compiled: {', '.join(sorted(new))}\n")
        return 3
    return 0


def _compiled() -> set[str]:
    """Return the names of the files of machine code that there are."""
    return {path.name for path in cache_folder().glob("*.o")}


if __name__ == "__main__":
    sys.exit(main())
