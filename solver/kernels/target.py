"""The processor that kernels are compiled for, and the number of lanes that they advance at once.

Neither changes a result, only how fast one comes: `own_target` suits runs side by side, and `ALONE`
lanes are the most for a run by itself. Every lane computes what it would compute alone:
a bundle has eight lanes at any width, and instants inside a step are looked at by eights. Every
sum is rounded as it is written; see `solver.kernels.emit.lane_arithmetic`.
"""

# mypy: disable-error-code="no-untyped-call"

import hashlib
import os
import platform
import re
from dataclasses import dataclass
from functools import cache
from typing import Any, Final

import llvmlite
from llvmlite import binding

from jointplay.records.failure import InvalidInput
from jointplay.solver.kernels.compiler import leave_out_slow_passes

WIDTHS: Final = {"1": 1, "4": 4, "8": 8}
"""For single numbers, and for vectors of 256 and of 512 bits."""
ALONE = 4
"""Most lanes of a kernel whose runs have none beside them. Vectors of 512 bits would be 1.5 times
slower there: a run waits for each result, and divisions of eight numbers take twice as long."""
CODE_LEVEL = 3
"""Level of optimisation of what generates code: the choice of instructions and registers."""
PROBE = """
declare <8 x double> @llvm.fma.v8f64(<8 x double>, <8 x double>, <8 x double>)
define <8 x double> @fused(<8 x double> %x, <8 x double> %y, <8 x double> %z) {
  %sum = call <8 x double> @llvm.fma.v8f64(<8 x double> %x, <8 x double> %y, <8 x double> %z)
  ret <8 x double> %sum
}
"""


@dataclass(frozen=True)
class Target:
    """A processor, as LLVM knows it, and the numbers that are computed side by side."""

    lanes: int
    processor: str
    features: str

    @property
    def mark(self) -> str:
        """Return twelve hexadecimal digits that tell code for it, by this compiler, from other."""
        about = (self, llvmlite.__version__, binding.llvm_version_info)
        return hashlib.sha256(repr(about).encode()).hexdigest()[:12]

    def machine(self) -> Any:
        """Return LLVM's generator of code for it, set as Numba sets its own, but for addresses.

        On x86 a module's numbers are within reach of its instructions (`machine_code` sees to
        that): to write out where each of them is made steps 6 % longer.
        """
        leave_out_slow_passes()
        binding.initialize_native_target()
        binding.initialize_native_asmprinter()
        on_x86 = platform.machine().lower() in ("x86_64", "amd64")
        return binding.Target.from_triple(binding.get_process_triple()).create_target_machine(
            cpu=self.processor,
            features=self.features,
            opt=CODE_LEVEL,
            reloc="pic" if on_x86 else "default",
            codemodel="small" if on_x86 else "jitdefault",
            jit=True,
        )


@cache
def own_target() -> Target:
    """Return what this process compiles for.

    The processor is the host, or what ``NUMBA_CPU_NAME`` and ``NUMBA_CPU_FEATURES`` say, as it is
    for Numba. ``JOINTPLAY_LANES`` chooses the lanes.

    Raises
    ------
    InvalidInput
        The variable is none of `WIDTHS`, or the processor has no fused products.
    """
    name, features = (os.environ.get(f"NUMBA_CPU_{what}") for what in ("NAME", "FEATURES"))
    return target_of(
        binding.get_host_cpu_name() if name is None else name,
        binding.get_host_cpu_features().flatten() if features is None else features,
        os.environ.get("JOINTPLAY_LANES"),
    )


def target_of(processor: str, features: str, chosen: str | None = None) -> Target:
    """Return a processor as a target; without a chosen width it has as many lanes as suit it.

    Eight where eight numbers are one vector there: some processors have such vectors, and are known
    to be slower with them.
    """
    if chosen and chosen not in WIDTHS:
        raise InvalidInput.at(
            "JOINTPLAY_LANES",
            f"It is '{chosen}'; it must be 1 (no vectors), 4 (vectors of 256 bits) or 8 (512"
            " bits). Unset it to have the width of the processor.",
        )
    found = Target(WIDTHS[chosen or "1"], processor, features)
    code = found.machine().emit_assembly(binding.parse_assembly(PROBE))
    if re.search(r"\bfma\b", code):  # a function of the C library
        raise InvalidInput.at(
            "NUMBA_CPU_NAME",
            f"The processor '{processor}' has no fused multiplication and addition (FMA), without"
            " which results would have other bits. Processors of 2013 and later have it:"
            " x86-64-v3, and any 64-bit Arm.",
        )
    return found if chosen else Target(8 if "zmm" in code else 4, processor, features)
