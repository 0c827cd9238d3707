"""`python -m jointplay.worker.warm`: compile the kernels of every preset, while an image is built.

With ``--check`` nothing may be left to compile: it proves that the kernels of an image are used
by the processor they run on.
"""

import argparse
import sys
import time
from typing import cast

from numba.core.event import install_recorder

from jointplay.solver.kernels.emit.tangents import compile_tangents
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.runs.simulate import Simulation
from jointplay.solver.scene import presets


def warm(name: str) -> float:
    """Compile or load a preset's kernels, those of exponents too; return the seconds."""
    began = time.perf_counter()
    job = {"kind": "simulate", "scene": {"preset": name}, "duration": 1e-3}
    admission = cast("Admission", admit(job))
    for _ in Simulation(admission).slices():
        pass
    compile_tangents(ready_kernel(admission.scene, admission.job["formulation"], admission.method))
    return time.perf_counter() - began


def main() -> int:
    """Warm every preset and say how long each took; 3 if a check finds something compiled."""
    parser = argparse.ArgumentParser(prog="python -m jointplay.worker.warm", description=__doc__)
    parser.add_argument("--check", action="store_true", help="fail if anything is compiled")
    arguments = parser.parse_args()
    with install_recorder("numba:compile") as compiled:
        for name in presets.names():
            sys.stdout.write(f"{name}: {warm(name):.1f} s\n")
    new = {event.data["dispatcher"].__name__ for _, event in compiled.buffer}
    if arguments.check and new:
        sys.stdout.write(f"{len(new)} functions had to be compiled: {', '.join(sorted(new))}\n")
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main())
