"""Functions of tapes, in the compiler's language: those of a module are in one piece.

They call one another. Each can be called in two ways: with addresses of numbers, as they do among
themselves and as Python does, and with arrays, as the loops do, which Numba compiles. Calls of
loops are counted.
"""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from numba.core.datamodel.registry import default_manager

from jointplay.solver.kernels.emit.functions import ARRAY, CALLS, OF_ARRAYS, WORK, Function
from jointplay.solver.kernels.emit.lane_arithmetic import declared
from jointplay.solver.kernels.emit.straight_line import ARGUMENTS, write

_ARRAY_MODEL = default_manager[WORK]
ARRAY_IN_LOOPS = re.sub(r"\w+\*", "ptr", str(_ARRAY_MODEL.get_value_type()))
"""LLVM's type of a work array in loops, a structure; the numbers' address is one of its parts."""
ADDRESS_OF_NUMBERS = _ARRAY_MODEL.get_field_position("data")
ON_ITS_OWN = "noinline nounwind alignstack(64)"
"""Attributes of a function that several call: it is not written into them, and its stack begins on
a line of the cache. Where vectors lay across two lines, by chance of where a process's stack is,
steps took 2 to 6 % longer."""


@dataclass(frozen=True)
class Source:
    """A function's tape and what it goes over; see `solver.kernels.emit.straight_line`."""

    name: str
    lines: tuple[str, ...] = ()
    over: str = "lanes"
    rows: int = 0

    @property
    def value(self) -> str:
        """LLVM's type of the function's value."""
        marks = self.over == "rows" or any(line.startswith("return ") for line in self.lines)
        return "i64" if marks else "void"

    def of_numbers(
        self, symbol: Callable[[str], str], lanes: int, attributes: str = ON_ITS_OWN
    ) -> str:
        """Return the function of addresses of numbers in LLVM's language, of these attributes."""
        return "\n".join(
            [
                f"define {self.value} {symbol(self.name)}({_listed(ARGUMENTS[self.over], ARRAY)})"
                f" {attributes} {{",
                "entry:",
                *write(self.lines, self.over, self.rows, self.value, symbol, lanes),
                "}",
            ]
        )

    def of_arrays(self, symbol: Callable[[str], str], before: Sequence[str]) -> str:
        """Return the function of arrays, which does something `before` it calls the other.

        Loops take an address for the value of a function that has none.
        """
        arguments = ARGUMENTS[self.over]
        value = "ptr" if self.value == "void" else self.value
        name = symbol(self.name + OF_ARRAYS)
        lines = [f"define {value} {name}({_listed(arguments, ARRAY_IN_LOOPS)}) nounwind {{"]
        lines += before
        for argument, kind in arguments.items():
            if kind == ARRAY:
                part = f"extractvalue {ARRAY_IN_LOOPS} {argument}, {ADDRESS_OF_NUMBERS}"
                lines.append(f"{argument}.numbers = {part}")
        given = {f"{a}.numbers" if kind == ARRAY else a: kind for a, kind in arguments.items()}
        call = f"call {self.value} {symbol(self.name)}({_listed(given, ARRAY)})"
        if self.value == "void":
            return "\n".join([*lines, call, "ret ptr null", "}"])
        return "\n".join([*lines, f"%value = {call}", f"ret {self.value} %value", "}"])

    def text(self, symbol: Callable[[str], str], lanes: int) -> str:
        """Return both functions, and how often loops called the second."""
        calls = symbol(self.name + CALLS)
        counted = [
            f"%before = load i64, ptr {calls}",
            "%now = add i64 %before, 1",
            f"store i64 %now, ptr {calls}",
        ]
        both = self.of_numbers(symbol, lanes), self.of_arrays(symbol, counted)
        return "\n".join([f"{calls} = global i64 0", *both])

    def function(self, prefix: str) -> Function:
        """Return the function, loaded under its name behind a prefix."""
        return Function(
            self.name, f"{prefix}.{self.name}", self.value, list(ARGUMENTS[self.over].values())
        )


def module_text(sources: Iterable[Source], prefix: str, lanes: int) -> str:
    """Return all functions, whose names begin with a prefix, for so many lanes at once."""

    def symbol(name: str) -> str:
        return f'@"{prefix}.{name}"'

    return "\n".join([*(one.text(symbol, lanes) for one in sources), declared(lanes)])


def _listed(arguments: Mapping[str, str], array: str) -> str:
    """Return arguments with their types, `array` being that of arrays."""
    return ", ".join(f"{array if k == ARRAY else k} {a}" for a, k in arguments.items())
