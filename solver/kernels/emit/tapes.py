"""Functions of tapes: each is compiled once, in one library, and known to callers by name alone.

Numba links the code of whatever a function calls into that function's own library, optimises it
there again and writes it out again; for a step and its stages that was a third of compilation.
"""

# mypy: disable-error-code="no-untyped-def,no-untyped-call,misc"

import hashlib
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from llvmlite import ir
from numba import float64, int64, njit, types, void
from numba.core import cgutils
from numba.extending import intrinsic

from jointplay.solver.kernels.emit.lane_arithmetic import DOUBLE, WORD
from jointplay.solver.kernels.emit.straight_line import write

OPTIONS: dict[str, Any] = {
    "cache": True,
    "error_model": "numpy",
    "fastmath": {"contract", "nsz", "arcp"},
}
ARRAYS = {"lanes": 1, "instants": 2, "row": 1, "rows": 1}
"""Arrays that a tape takes, by what it goes over; see `straight_line`."""
INDEXED = ("instants", "row")
"""Over what tapes take an index behind the arrays."""


@dataclass(frozen=True)
class _Function:
    """A tape and what it goes over."""

    name: str
    tape: str
    over: str
    rows: int

    @property
    def value(self) -> Any:
        """Numba's type of its value."""
        return {"rows": int64}.get(self.over, float64 if "\nreturn " in self.tape else types.void)

    def declared(self, module: Any, prefix: str) -> Any:
        """Return the function in a module of the intermediate language, where it may be defined."""
        values = {int64: WORD, float64: DOUBLE, types.void: ir.VoidType()}
        arguments = [DOUBLE.as_pointer()] * ARRAYS[self.over] + [WORD] * (self.over in INDEXED)
        kind = ir.FunctionType(values[self.value], arguments)
        return cgutils.get_or_insert_function(module, kind, f"{prefix}.{self.name}")

    def define(self, module: Any, prefix: str) -> None:
        """Write the function's code."""
        function = self.declared(module, prefix)
        function.attributes.add("nounwind")
        builder = ir.IRBuilder(function.append_basic_block("entry"))
        source, target = function.args[0], function.args[ARRAYS[self.over] - 1]
        index = function.args[-1] if self.over in INDEXED else None
        value = write(self.tape, builder, self.over, self.rows, source, target, index)
        if value is None:
            builder.ret_void()
        else:
            builder.ret(value)


class Tapes:
    """Functions of one generated module: of tapes, and of Numba's that call them."""

    def __init__(self) -> None:
        self._functions: list[_Function] = []
        self._callers: list[tuple[Any, dict[str, Any], Callable[..., Any]]] = []

    @cached_property
    def _prefix(self) -> str:
        text = repr(self._functions)  # all are there when the first is asked for its name
        return f"jointplay.{hashlib.sha256(text.encode()).hexdigest()[:24]}"

    def add(self, name: str, tape: str, over: str, rows: int = 0) -> Any:
        """Return a tape as a function inside kernels: of W, of W and S, of an index behind them.

        Parameters
        ----------
        over, rows
            See `solver.kernels.emit.straight_line`.
        """
        one = _Function(name, tape, over, rows)
        self._functions.append(one)

        def generate(context, builder, signature, arguments):
            count = ARRAYS[over]
            pointers = [
                context.make_array(kind)(context, builder, value=array).data
                for kind, array in zip(signature.args[:count], arguments, strict=False)
            ]
            function = one.declared(builder.module, self._prefix)
            value = builder.call(function, [*pointers, *arguments[count:]])
            return context.get_dummy_value() if one.value == types.void else value

        def over_one(_typing, W):  # noqa: N803  (as in every generated kernel)
            return one.value(W), generate

        def at_index(_typing, W, index):  # noqa: N803
            return one.value(W, int64), generate

        def inside(_typing, W, S, index):  # noqa: N803
            return one.value(W, S, int64), generate

        return intrinsic({"row": at_index, "instants": inside}.get(over, over_one))

    def function(self, signature: Any, *, inner: bool) -> Callable[[Any], Any]:
        """Note a function that `compile` compiles; Python may call it unless it is an inner one."""

        def note(function: Callable[..., Any]) -> Callable[..., Any]:
            self._callers.append((signature, {"no_cpython_wrapper": inner}, function))
            return function

        return note

    def definitions(self) -> Any:
        """Return a function inside kernels in whose library all tapes are defined."""

        def write_all(_typing):
            def generate(context, builder, _signature, _arguments):
                for one in self._functions:
                    one.define(builder.module, self._prefix)
                return context.get_dummy_value()

            return types.void(), generate

        return intrinsic(write_all)

    def compile(self, definitions: Callable[[], None], names: dict[str, Any]) -> None:
        """Compile what defines all tapes, then the noted functions, in place of their names."""
        first: dict[str, Any] = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
        for signature, without, function in [(void(), first, definitions), *self._callers]:
            names[function.__name__] = njit(signature, **OPTIONS, **without)(function)
