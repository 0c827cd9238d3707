"""Number of lanes that kernels advance at once: as many floats as the processor's vectors hold.

It changes no result, only how fast one comes: every lane computes what it would compute alone, a
bundle has eight lanes at any width, and instants inside a step are looked at by eights.
"""

# mypy: disable-error-code="no-untyped-call"

import os
from typing import Final

import numba
from llvmlite import binding
from numba.core.codegen import get_host_cpu_features

from jointplay.records.failure import InvalidInput

WIDTHS: Final = {"4": 4, "8": 8}
"""For vectors of 256 and of 512 bits."""

ADDITION = """
define <8 x double> @add(<8 x double> %x, <8 x double> %y) {
  %sum = fadd <8 x double> %x, %y
  ret <8 x double> %sum
}
"""


def chosen_lanes() -> int:
    """Return what ``JOINTPLAY_LANES`` says, or what suits the processor that is compiled for.

    Raises
    ------
    InvalidInput
        The variable is neither 4 nor 8.
    """
    chosen = os.environ.get("JOINTPLAY_LANES")
    if not chosen:
        return 8 if has_long_vectors() else 4
    if chosen not in WIDTHS:
        raise InvalidInput.at(
            "JOINTPLAY_LANES",
            f"It is '{chosen}'; it must be 4 (vectors of 256 bits) or 8 (512 bits). Unset"
            " it to have the width of the processor.",
        )
    return WIDTHS[chosen]


def has_long_vectors() -> bool:
    """Whether an addition of eight floats is compiled to one of 512 bits.

    For the processor that Numba compiles for: the host, or what ``NUMBA_CPU_NAME`` and
    ``NUMBA_CPU_FEATURES`` say. Some that have such vectors are known to be slower with them.
    """
    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    name, features = target_processor()
    machine = binding.Target.from_default_triple().create_target_machine(
        cpu=name, features=features
    )
    return "zmm" in machine.emit_assembly(binding.parse_assembly(ADDITION))


def target_processor() -> tuple[str, str]:
    """Return name and features of the processor that Numba compiles for, as LLVM knows them."""
    name, features = numba.config.CPU_NAME, numba.config.CPU_FEATURES  # type: ignore[attr-defined]
    return (
        binding.get_host_cpu_name() if name is None else name,
        get_host_cpu_features() if features is None else features,
    )


LANES: Final = chosen_lanes()
