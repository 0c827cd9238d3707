"""`python -m benchmarks.device.assembled`: what a device's code comes to, where there is no device.

NVIDIA's assembler makes code of the kernel, and its disassembler shows that: instructions of an
attempt at a step, of how many in all, and by kind. Where an attempt is no function of its own, the
loop counts, too. Both programs come with CUDA, or with the wheels nvidia-cuda-nvcc-cu12 and
nvidia-cuda-nvdisasm.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

import numpy as np

from benchmarks.device.prepare import CAPACITY, MECHANISMS, texts, work_of
from jointplay.solver.kernels.device.compiled import ptx
from jointplay.solver.kernels.device.lanes import Sizes
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from tests.solver.readable_mechanics import preset

ARCHITECTURE = "sm_90"
INSTRUCTION = re.compile(r"/\*[0-9a-f]{4,}\*/\s+(?:@!?U?P\w+ )?([A-Z][A-Z0-9_]*)[^;]*;")
KINDS = {
    "of doubles": ("DFMA", "DMUL", "DADD", "DSETP"),
    "of memory": ("LD", "ST", "LDL", "STL", "LDG", "STG"),
    "constants": ("UMOV", "ULDC", "LDC", "R2UR"),
}


def main() -> None:
    """Print a line for each mechanism and variant."""
    programs = assembler(), tool("nvdisasm")
    if None in programs:
        sys.exit(
            "ptxas or nvdisasm is missing: pip install nvidia-cuda-nvcc-cu12 nvidia-cuda-nvdisasm"
        )
    for name in MECHANISMS:
        for variant, text in code_of(name).items():
            lines = shown(text, *map(str, programs))
            found = Counter(INSTRUCTION.findall(attempt_in(lines)))
            kinds = (f"{sum(found[one] for one in of)} {kind}" for kind, of in KINDS.items())
            total = f"{found.total():6d} instructions of {len(INSTRUCTION.findall(lines)):5d}"
            print(f"{name + variant:<26}{total}; {', '.join(kinds)}", flush=True)


def shown(text: str, assemble: str, show: str) -> str:
    """Return a device's instructions, in lines, of a kernel's code."""
    with tempfile.TemporaryDirectory() as folder:
        source, code = Path(folder, "kernel.ptx"), Path(folder, "kernel.cubin")
        source.write_text(text)
        subprocess.run([assemble, f"-arch={ARCHITECTURE}", "-o", code, source], check=True)
        done = subprocess.run([show, "-c", code], check=True, capture_output=True, text=True)
    return done.stdout


def attempt_in(lines: str) -> str:
    """Return the lines of an attempt at a step: a function, or where threads meet in the loop."""
    functions = re.split(r"^(?=[$\w]+:$)", lines, flags=re.MULTILINE)
    return next(one for one in functions if "BAR.SYNC" in one)


def code_of(name: str) -> dict[str, str]:
    """Return a mechanism's code for a device, by variant."""
    kernel = ready_kernel(preset(name), "reduced", "tsitouras")
    bundle = Bundle(kernel, [LaneProblem(preset(name), 1e6, 1e-6, 1e6, 1, 2**40, 0.0)], watch=False)
    sizes = Sizes(0, kernel.layout.size, *CAPACITY)
    found = texts(kernel, sizes, work_of(bundle)[:, :1], on_host=False)
    return {variant: ptx(text) for variant, text in found.items()}


def assembler() -> Path | None:
    """Return ptxas, if it is there."""
    return tool("ptxas")


def tool(name: str) -> Path | None:
    """Return one of NVIDIA's programs: of CUDA, or of a wheel beside this Python's packages."""
    there = shutil.which(name)
    if there is not None:
        return Path(there)
    packages = Path(np.__file__).parents[1]
    return next((p for p in packages.glob(f"nvidia/*/bin/{name}") if p.is_file()), None)


if __name__ == "__main__":
    main()
