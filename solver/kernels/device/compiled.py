"""The loop and a kernel's text, linked and compiled: for a device, or to be run here."""

# mypy: disable-error-code="no-untyped-call"

from collections.abc import Collection, Sequence
from typing import Any

import numpy as np
from llvmlite import binding
from numpy.typing import NDArray

from jointplay.solver.kernels.device.kernel_text import LOOP, PARTS, kernel_text
from jointplay.solver.kernels.device.lanes import Sizes
from jointplay.solver.kernels.device.loop_text import loop_text
from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.target import own_target

TRIPLE, OLDEST, DIALECT = "nvptx64-nvidia-cuda", "sm_80", "+ptx71"
"""Devices since 2020 take code for the oldest of them: the driver makes their own of it."""
LEVEL = 3
ROUNDS = 2
"""Times that the passes run: addresses of functions are known after the first."""


def code(sources: Sequence[Source], slots: NDArray[np.void], sizes: Sizes, *, on_host: bool) -> str:
    """Return what a device's driver takes for a kernel; seconds. Arguments as of `kernel_text`."""
    text = kernel_text(sources, slots, sizes, on_host=on_host)
    return text if on_host else ptx(text)


def ptx(text: str) -> str:
    """Return a kernel's text for a device in the language that its driver takes."""
    binding.initialize_all_targets()
    binding.initialize_all_asmprinters()
    target = binding.Target.from_triple(TRIPLE)
    machine = target.create_target_machine(cpu=OLDEST, features=DIALECT, opt=LEVEL)
    return str(machine.emit_assembly(_linked(text, machine, TRIPLE, PARTS.keys())))


def host_code(text: str) -> Any:
    """Return what holds the code of a kernel's text for this processor; its functions: `PARTS`."""
    machine = own_target().machine()
    module = _linked(text, machine, binding.get_process_triple(), PARTS.values())
    engine = binding.create_mcjit_compiler(module, machine)
    engine.finalize_object()
    return engine


def _linked(text: str, machine: Any, triple: str, entries: Collection[str]) -> Any:
    """Return a module of which only entries are seen from outside, with all calls known."""
    module, loop = (binding.parse_assembly(one) for one in (text, loop_text()))
    for function in loop.functions:
        if function.name != LOOP and not function.is_declaration:
            function.add_function_attribute("noinline")
    for one in (module, loop):
        one.triple, one.data_layout = triple, str(machine.target_data)
    module.link_in(loop)
    for one in (*module.functions, *module.global_variables):
        if one.name not in entries and not one.is_declaration:
            one.linkage = "internal"
    module.verify()
    options = binding.create_pipeline_tuning_options(LEVEL)
    options.loop_vectorization = options.slp_vectorization = False
    for _ in range(ROUNDS):
        builder = binding.create_pass_builder(machine, options)
        builder.getModulePassManager().run(module, builder)
    return module
