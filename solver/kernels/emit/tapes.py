"""Functions of tapes, in the compiler's language: those of a module are in one piece.

They call one another, and Python calls them. Loops call a second function of each, which counts.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from jointplay.solver.kernels.emit.functions import CALL_COUNT, COUNTED, Function, Signature
from jointplay.solver.kernels.emit.lane_arithmetic import declared
from jointplay.solver.kernels.emit.straight_line import ARGUMENTS, write

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

    def function_text(
        self, symbol: Callable[[str], str], lanes: int, attributes: str = ON_ITS_OWN
    ) -> str:
        """Return the function in LLVM's language, of these attributes."""
        return "\n".join(
            [
                f"define {self.value} {symbol(self.name)}({self._parameters}) {attributes} {{",
                "entry:",
                *write(self.lines, self.over, self.rows, self.value, symbol, lanes),
                "}",
            ]
        )

    def called_by_loops(self, symbol: Callable[[str], str], before: Sequence[str]) -> str:
        """Return the function that does something `before` it calls the other."""
        name, call = symbol(self.name + COUNTED), f"call {self.value} {symbol(self.name)}"
        lines = [f"define {self.value} {name}({self._parameters}) nounwind {{", *before]
        if self.value == "void":
            return "\n".join([*lines, f"{call}({self._parameters})", "ret void", "}"])
        lines.append(f"%value = {call}({self._parameters})")
        return "\n".join([*lines, f"ret {self.value} %value", "}"])

    def text(self, symbol: Callable[[str], str], lanes: int) -> str:
        """Return both functions, and how often loops called the second."""
        calls = symbol(self.name + CALL_COUNT)
        counted = [
            f"%before = load i64, ptr {calls}",
            "%now = add i64 %before, 1",
            f"store i64 %now, ptr {calls}",
        ]
        both = self.function_text(symbol, lanes), self.called_by_loops(symbol, counted)
        return "\n".join([f"{calls} = global i64 0", *both])

    @property
    def _parameters(self) -> str:
        return ", ".join(f"{kind} {name}" for name, kind in ARGUMENTS[self.over].items())

    def function(self, prefix: str) -> Function:
        """Return the function, loaded under its name behind a prefix."""
        signature = Signature(self.value, tuple(ARGUMENTS[self.over].values()))
        return Function(self.name, f"{prefix}.{self.name}", signature)


def module_text(sources: Iterable[Source], prefix: str, lanes: int) -> str:
    """Return all functions, whose names begin with a prefix, for so many lanes at once."""

    def symbol(name: str) -> str:
        return f'@"{prefix}.{name}"'

    return "\n".join([*(one.text(symbol, lanes) for one in sources), declared(lanes)])
