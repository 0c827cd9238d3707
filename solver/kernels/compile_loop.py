"""`python -m jointplay.solver.kernels.compile_loop [PART ...]`: compile the loop into the cache.

Parts that are named are compiled in this process; without any, those that are not in the cache yet,
each in a process of its own. See `solver.kernels.loop_code`.
"""

# mypy: disable-error-code="no-untyped-call"

import sys
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any

import numba
from filelock import FileLock
from llvmlite import binding
from numba import types

from jointplay.solver.kernels.cache import without_collection, write_whole
from jointplay.solver.kernels.entry_point import (
    FLOATING,
    INTEGRAL,
    POINTER,
    Argument,
    Array,
    EntryPoint,
    Number,
)
from jointplay.solver.kernels.jit import INNER
from jointplay.solver.kernels.loop import (
    advance,
    dense_rows,
    entry_points,
    periods,
    replay,
    tangent,
)
from jointplay.solver.kernels.loop.extremes.window import extremes_in_steps
from jointplay.solver.kernels.loop_code import FOR_RUNS, FOR_WINDOWS, PARTS, begin, path_of
from jointplay.solver.kernels.loop_library import ARITHMETIC, MEMORY
from jointplay.solver.kernels.target import own_target

FUNCTIONS: Mapping[str, Mapping[EntryPoint, Callable[..., Any]]] = {
    FOR_RUNS: {
        entry_points.advance: advance.advance,
        entry_points.observe_rows: dense_rows.observe_rows,
        entry_points.set_clocks: periods.set_clocks,
        entry_points.plan_anew: periods.plan_anew,
        entry_points.start_tangents: tangent.start_tangents,
        entry_points.measure_tangent: tangent.measure_tangent,
    },
    FOR_WINDOWS: {
        entry_points.find_steps: replay.find_steps,
        entry_points.states_in_steps: replay.states_in_steps,
        entry_points.make_again: replay.make_again,
        entry_points.extremes_in_steps: extremes_in_steps.extremes_in_steps,
    },
}
"""Functions of the entry points of each part."""
LLVM_TYPES = {POINTER: "ptr", INTEGRAL: "i64", FLOATING: "double"}
"""Types of the words that an entry point takes."""


def compile_part(part: str) -> None:
    """Compile a part into the cache, if it is not there; only one process compiles."""
    path = path_of(part)
    with FileLock(path.with_suffix(".lock")), without_collection():
        if not path.exists():
            write_whole(path, code_of(part))


def code_of(part: str) -> bytes:
    """Return the machine code of a part, for what this process is."""
    module = binding.parse_assembly(ARITHMETIC + MEMORY)
    for entry_point, function in FUNCTIONS[part].items():
        module.link_in(binding.parse_assembly(_text(entry_point, function)))
    module.verify()
    machine = own_target().machine()
    _keep_only(module, {one.symbol for one in FUNCTIONS[part]}, machine)
    return bytes(machine.emit_object(module))


def _keep_only(module: Any, symbols: Collection[str], machine: Any) -> None:
    """Leave out of a module what these functions do not call, and the names of what they do."""
    for one in (*module.functions, *module.global_variables):
        if not one.is_declaration and one.name not in symbols:
            one.linkage = "private"
    builder = binding.create_pass_builder(machine, binding.create_pipeline_tuning_options())
    passes = binding.create_new_module_pass_manager()
    passes.add_always_inliner_pass()
    passes.add_global_dead_code_eliminate_pass()
    passes.run(module, builder)


def _text(entry_point: EntryPoint, function: Callable[..., Any]) -> str:
    """Return a function in LLVM's language, with all that it calls, and its entry point."""
    value = types.void if entry_point.value is None else numba_type(entry_point.value)
    signature = value(*map(numba_type, entry_point.arguments))
    compiled = numba.njit(signature, **INNER)(function)
    (overload,) = compiled.overloads.values()
    text: str = overload.library.get_llvm_str()
    return text + _entry(entry_point, overload.fndesc.llvm_func_name)


def _entry(entry_point: EntryPoint, function: str) -> str:
    """Return what takes an entry point's words from their address, and calls the function."""
    kinds = [LLVM_TYPES[word] for word in entry_point.words]
    lines = [f'define i32 @"{entry_point.symbol}"(ptr %words) {{']
    for i, kind in enumerate(kinds):
        lines.append(f"%place{i} = getelementptr i64, ptr %words, i64 {i}")
        if i > 1:
            lines.append(f"%word{i} = load {kind}, ptr %place{i}")
    passed = (f"{kind} %word{i}" for i, kind in enumerate(kinds) if i > 1)
    given = ", ".join(["ptr %place0", "ptr %place1", *passed])
    return "\n".join([*lines, f"%code = call i32 @{function}({given})", "ret i32 %code", "}", ""])


def numba_type(argument: Argument) -> Any:
    """Return what an argument is for Numba."""
    if isinstance(argument, Number):
        return {INTEGRAL: types.int64, FLOATING: types.float64}[argument.words]
    if isinstance(argument, Array):
        return types.Array(numba.from_dtype(argument.dtype), argument.dimensions, "C")
    return types.NamedTuple(list(map(numba_type, argument.members)), argument.kind)


def main(parts: Sequence[str]) -> int:
    """Compile the parts that are named, or all. Returns 1 if one does not compile, else 0."""
    for part in parts:
        compile_part(part)
    begun = [] if parts else [begin(part) for part in PARTS]
    codes = [one.wait() for one in begun if one is not None]
    return int(any(codes))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
