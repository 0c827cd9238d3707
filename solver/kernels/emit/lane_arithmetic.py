"""Vectors of lanes in LLVM's language: what operations are built from.

Code is written as text at once: to build objects and then turn them into text took longer.
"""

import struct
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache

from jointplay.solver.kernels.lanes import LANES

NUMBERS, WORDS = f"<{LANES} x double>", f"<{LANES} x i64>"
TRUTHS, PLACES = f"<{LANES} x i1>", f"<{LANES} x i32>"
FLAGS = "nsz arcp contract"
"""Liberties that arithmetic has: see `solver.kernels.record.operations`."""


@cache
def same(value: float) -> str:
    """Return one number in every lane."""
    return f"splat (double 0x{struct.pack('>d', value).hex()})"


def word(value: int) -> str:
    """Return one whole number of 64 bits in every lane."""
    return f"splat (i64 {value})"


class Lanes:
    """Body of a function, line by line; a value is its name there, or a constant."""

    same, word = staticmethod(same), staticmethod(word)

    def __init__(self) -> None:
        self.lines: list[str] = []
        self._block = "entry"
        self._differences: dict[str, tuple[str, str]] = {}
        self._names = 0

    def new(self, code: str) -> str:
        """Write an instruction and return the name of its value."""
        self._names += 1
        name = f"%x{self._names}"
        self.lines.append(f"{name} = {code}")
        return name

    @contextmanager
    def loop(self, first: str, end: str) -> Iterator[str]:
        """Have what is written inside repeated for indices from `first` on, up to `end`."""
        self._names += 1
        number = self._names
        index, following, before = f"%i{number}", f"%j{number}", self._block
        self.lines += [f"br label %head{number}", f"head{number}:", ""]
        place = len(self.lines) - 1
        more = self.new(f"icmp slt i64 {index}, {end}")
        self.lines.append(f"br i1 {more}, label %body{number}, label %end{number}")
        self._begin(f"body{number}")
        yield index
        self.lines.append(f"{following} = add nsw i64 {index}, 1")
        self.lines.append(f"br label %head{number}")
        self.lines[place] = (
            f"{index} = phi i64 [ {first}, %{before} ], [ {following}, %{self._block} ]"
        )
        self._begin(f"end{number}")

    def _begin(self, block: str) -> None:
        self.lines.append(f"{block}:")
        self._block = block

    def arithmetic(self, operation: str, x: str, y: str) -> str:
        """Return what LLVM's operation makes of numbers."""
        name = self.new(f"{operation} {FLAGS} {NUMBERS} {x}, {y}")
        if operation == "fsub":
            self._differences[name] = x, y
        return name

    def negative(self, x: str) -> str:
        """Return -x."""
        return self.new(f"fneg {FLAGS} {NUMBERS} {x}")

    def greater(self, x: str, y: str) -> str:
        """Return where x > y."""
        return self.new(f"fcmp {FLAGS} ogt {NUMBERS} {x}, {y}")

    def positive(self, x: str) -> str:
        """Return where x > 0; a difference is compared, not formed: it may be a maximum."""
        return self.greater(*self._differences.get(x, (x, same(0.0))))

    def choose(self, where: str, x: str, y: str, kind: str = NUMBERS) -> str:
        """Return x where something holds, else y."""
        return self.new(f"select {TRUTHS} {where}, {kind} {x}, {kind} {y}")

    def on_words(self, operation: str, x: str, y: str) -> str:
        """Return what LLVM's operation makes of whole numbers."""
        return self.new(f"{operation} {WORDS} {x}, {y}")

    def bits(self, x: str) -> str:
        """Return the bits of numbers as words."""
        return self.new(f"bitcast {NUMBERS} {x} to {WORDS}")

    def numbers(self, words: str) -> str:
        """Return the numbers of these bits."""
        return self.new(f"bitcast {WORDS} {words} to {NUMBERS}")

    def whole(self, x: str) -> str:
        """Return whole numbers as words."""
        return self.new(f"fptosi {NUMBERS} {x} to {WORDS}")

    def from_whole(self, words: str) -> str:
        """Return words as numbers."""
        return self.new(f"sitofp {WORDS} {words} to {NUMBERS}")

    def call(self, name: str, x: str) -> str:
        """Return a function of the processor's own, one of `INTRINSIC`: no call is left of it."""
        return self.new(f"call {NUMBERS} @llvm.{name}.v{LANES}f64({NUMBERS} {x})")


INTRINSIC = ("fabs", "sqrt", "floor")
DECLARED = "\n".join(f"declare {NUMBERS} @llvm.{name}.v{LANES}f64({NUMBERS})" for name in INTRINSIC)
"""Lines of a module that uses them."""


def mask(lanes: Lanes, x: str) -> str:
    """Return bit k of eight for each lane k whose number is positive."""
    bits = lanes.new(f"bitcast {TRUTHS} {lanes.greater(x, same(0.0))} to i{LANES}")
    return bits if LANES == 8 else lanes.new(f"zext i{LANES} {bits} to i8")


def everywhere(lanes: Lanes, number: str) -> str:
    """Return a number in every lane."""
    alone = lanes.new(f"insertelement {NUMBERS} undef, double {number}, i32 0")
    return _shuffled(lanes, alone, alone, [0] * LANES)


def lower_and_upper(lanes: Lanes, lower: str, upper: str) -> str:
    """Return the lower half of one and the upper half of the other."""
    half = LANES // 2
    return _shuffled(lanes, lower, upper, [*range(half), *range(LANES + half, 2 * LANES)])


def largest(lanes: Lanes, x: str) -> str:
    """Return the largest of the lanes' numbers, which are all numbers."""
    width = LANES // 2
    while width:
        other = _shuffled(lanes, x, x, [(k + width) % LANES for k in range(LANES)])
        x = lanes.choose(lanes.greater(x, other), x, other)
        width //= 2
    return lanes.new(f"extractelement {NUMBERS} {x}, i32 0")


def _shuffled(lanes: Lanes, x: str, y: str, places: list[int]) -> str:
    chosen = ", ".join(f"i32 {place}" for place in places)
    return lanes.new(f"shufflevector {NUMBERS} {x}, {NUMBERS} {y}, {PLACES} <{chosen}>")
