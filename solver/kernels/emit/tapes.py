"""Functions of tapes: all of a generated module are compiled in one piece, and call one another.

Each can be called in two ways: with addresses of numbers, as they do among themselves and as Python
does, and with arrays, as the loops do, which Numba compiles. Calls of loops are counted.
"""

import hashlib
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from numba.core.datamodel.registry import default_manager

from jointplay.solver.kernels.emit.function import ARRAY, CALLS, OF_ARRAYS, Function
from jointplay.solver.kernels.emit.functions import WORK
from jointplay.solver.kernels.emit.lane_arithmetic import declared
from jointplay.solver.kernels.emit.machine_code import load_code
from jointplay.solver.kernels.emit.straight_line import ARGUMENTS, write
from jointplay.solver.kernels.target import Target, own_target

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
    """A tape and what it goes over; see `solver.kernels.emit.straight_line`."""

    name: str
    tape: str
    over: str
    rows: int

    @property
    def value(self) -> str:
        """LLVM's type of the function's value."""
        if self.over == "rows":
            return "i64"
        return "double" if "\nreturn " in self.tape else "void"

    def of_numbers(
        self, symbol: Callable[[str], str], lanes: int, attributes: str = ON_ITS_OWN
    ) -> str:
        """Return the function of addresses of numbers in LLVM's language, of these attributes."""
        return "\n".join(
            [
                f"define {self.value} {symbol(self.name)}({_listed(ARGUMENTS[self.over], ARRAY)})"
                f" {attributes} {{",
                "entry:",
                *write(self.tape, self.over, self.rows, self.value, symbol, lanes),
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


def _listed(arguments: Mapping[str, str], array: str) -> str:
    """Return arguments with their types, `array` being that of arrays."""
    return ", ".join(f"{array if k == ARRAY else k} {a}" for a, k in arguments.items())


class Tapes:
    """Functions of one generated module."""

    def __init__(self) -> None:
        self.sources: list[Source] = []

    def add(self, name: str, tape: str, over: str = "lanes", rows: int = 0) -> None:
        """Add a function that does what a tape says.

        Parameters
        ----------
        over, rows
            See `solver.kernels.emit.straight_line`.
        """
        self.sources.append(Source(name, f"\n{tape}", over, rows))

    def compiled(
        self, file: str | None = None, lanes: int | None = None, target: Target | None = None
    ) -> dict[str, Function]:
        """Return all functions by name, compiled or, beside the module's file, found to be.

        Parameters
        ----------
        lanes
            Advanced at once; by default as many as the target has.
        target
            That they are for; by default that of this process.
        """
        target = target or own_target()
        target = replace(target, lanes=lanes or target.lanes)
        digest = hashlib.sha256(repr((self.sources, target)).encode()).hexdigest()[:24]
        prefix = f"jointplay.{digest}"

        def symbol(name: str) -> str:
            return f'@"{prefix}.{name}"'

        def text() -> str:
            functions = (one.text(symbol, target.lanes) for one in self.sources)
            return "\n".join([*functions, declared(target.lanes)])

        load_code(text, target, None if file is None else Path(file))
        return {
            one.name: Function(
                one.name, f"{prefix}.{one.name}", one.value, list(ARGUMENTS[one.over].values())
            )
            for one in self.sources
        }
