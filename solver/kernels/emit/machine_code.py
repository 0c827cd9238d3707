"""Machine code of generated modules: compiled by LLVM, loaded into the process.

Numba, which compiles the loops that call it, would optimise such a module three times, and compile
and keep an entry to each function for itself: more than half of the compilation of a press.
"""

from collections.abc import Callable
from functools import cache
from threading import Lock
from typing import Any

from llvmlite import binding

from jointplay.solver.kernels.compiler import order_instructions
from jointplay.solver.kernels.target import Target, own_target

LEVEL_OF_FUNCTIONS, LEVEL_OF_MODULE = 1, 3
"""Levels of optimisation before code is generated. The passes that Numba runs, the highest level of
functions, too, and some between both, make the same machine code, and take longer."""
LONG = 8_000_000
"""Bytes of text (26 four-bars in `reduced`, 14 in `lagrange`) beyond which instructions stay in the
order in which they are written: to order them takes three times as long for twice the length."""


_loading = Lock()
_loaded: set[str] = set()


def is_loaded(name: str) -> bool:
    """Return whether this process has loaded the code of a module."""
    return name in _loaded


def load_code(name: str, code: Callable[[], bytes]) -> None:
    """Load the code of a module, as `compiled` returns it, unless this process has done so.

    `name` : of the module. `code` : returns it; that may take long, and other threads go on.
    """
    if is_loaded(name):
        return
    found = code()
    with _loading:
        if name not in _loaded:
            _engine().add_object_file(binding.ObjectFileRef.from_data(found))
            _loaded.add(name)


def address_of_symbol(name: str) -> int:
    """Return the address of a loaded function, or of a number that loaded code keeps."""
    address = int(_engine().get_global_value_address(name))
    if address == 0:
        raise LookupError(f"no code is loaded of '{name}'")
    return address


def compiled(text: str, target: Target) -> bytes:
    """Return what a module's text in LLVM's language comes to."""
    machine = target.machine()
    module = binding.parse_assembly(text)
    module.data_layout = str(machine.target_data)
    module.verify()
    for function in module.functions:
        builder = _passes(machine, LEVEL_OF_FUNCTIONS)
        builder.getFunctionPassManager().run(function, builder)
    builder = _passes(machine, LEVEL_OF_MODULE)
    builder.getModulePassManager().run(module, builder)
    order_instructions(len(text) < LONG)
    return bytes(machine.emit_object(module))


def _passes(machine: Any, level: int) -> Any:
    options = binding.create_pipeline_tuning_options(level)
    return binding.create_pass_builder(machine, options)


@cache
def _engine() -> Any:
    """Return what holds all code that is loaded, as long as the process lives.

    Its manager of memory keeps a module's code and numbers together.
    """
    machine = own_target().machine()
    return binding.create_mcjit_compiler(binding.parse_assembly(""), machine, use_lmm=True)
