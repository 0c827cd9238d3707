"""Vectors of lanes in LLVM's language: what operations are built from.

Code is written as text at once: to build objects and then turn them into text took longer.
"""

import struct
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache

ALIGNED = 8
"""Bytes that an address is surely a multiple of; `solver.lanes` has arrays begin on 64."""


@cache
def same(value: float) -> str:
    """Return one number in every lane."""
    return f"splat (double 0x{struct.pack('>d', value).hex()})"


def word(value: int) -> str:
    """Return one whole number of 64 bits in every lane."""
    return f"splat (i64 {value})"


class Builder:
    """Body of a function, line by line; a value is its name there, or a constant."""

    same, word = staticmethod(same), staticmethod(word)

    def __init__(self, count: int) -> None:
        """Begin with nothing, for vectors of `count` lanes."""
        self.count = count
        self.numbers_type, self.words_type = f"<{count} x double>", f"<{count} x i64>"
        self.lines: list[str] = []
        self._block = "entry"
        self._differences: dict[str, tuple[str, str]] = {}
        self._products: dict[str, tuple[str, str]] = {}
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
        line = len(self.lines) - 1
        more = self.new(f"icmp slt i64 {index}, {end}")
        self.lines.append(f"br i1 {more}, label %body{number}, label %end{number}")
        self._begin(f"body{number}")
        yield index
        self.lines.append(f"{following} = add nsw i64 {index}, 1")
        self.lines.append(f"br label %head{number}")
        self.lines[line] = (
            f"{index} = phi i64 [ {first}, %{before} ], [ {following}, %{self._block} ]"
        )
        self._begin(f"end{number}")

    @contextmanager
    def where(self, x: str) -> Iterator[list[str]]:
        """Have what is written inside done if a number is positive in any lane.

        Yields the blocks that what follows comes from: the one inside, the one before.
        """
        self._names += 1
        then, behind = f"then{self._names}", f"behind{self._names}"
        bits = self.new(f"bitcast <{self.count} x i1> {self.positive(x)} to i{self.count}")
        found = self.new(f"icmp ne i{self.count} {bits}, 0")
        self.lines.append(f"br i1 {found}, label %{then}, label %{behind}")
        ways = [then, self._block]
        self._begin(then)
        yield ways
        ways[0] = self._block
        self.lines.append(f"br label %{behind}")
        self._begin(behind)

    def either(self, ways: list[str], inside: str, before: str) -> str:
        """Return a value from inside if that was done, else one from before; see `where`."""
        (one, other), kind = ways, self.numbers_type
        return self.new(f"phi {kind} [ {inside}, %{one} ], [ {before}, %{other} ]")

    def _begin(self, block: str) -> None:
        self.lines.append(f"{block}:")
        self._block = block

    def arithmetic(self, operation: str, x: str, y: str) -> str:
        """Return what LLVM's operation makes of numbers; a sum of a product is rounded once.

        That is written out, for left to itself LLVM has every kind of processor round another sum.
        """
        if operation in ("fadd", "fsub") and (x in self._products or y in self._products):
            name = self._fused(operation, x, y)
        else:
            name = self.new(f"{operation} {self.numbers_type} {x}, {y}")
        if operation == "fmul":
            self._products[name] = x, y
        if operation == "fsub":
            self._differences[name] = x, y
        return name

    def _fused(self, operation: str, x: str, y: str) -> str:
        """Return x + y or x - y, of which y is a product, or else x."""
        if y in self._products:
            (a, b), c = self._products[y], x
            a = self.negative(a) if operation == "fsub" else a
        else:
            (a, b), c = self._products[x], self.negative(y) if operation == "fsub" else y
        return self.call("fma", a, b, c)

    def negative(self, x: str) -> str:
        """Return -x."""
        return self.new(f"fneg {self.numbers_type} {x}")

    def greater(self, x: str, y: str) -> str:
        """Return where x > y."""
        return self.new(f"fcmp ogt {self.numbers_type} {x}, {y}")

    def positive(self, x: str) -> str:
        """Return where x > 0; a difference is compared, not formed: it may be a maximum."""
        return self.greater(*self._differences.get(x, (x, same(0.0))))

    def choose(self, where: str, x: str, y: str) -> str:
        """Return x where something holds, else y."""
        kind = self.numbers_type
        return self.new(f"select <{self.count} x i1> {where}, {kind} {x}, {kind} {y}")

    def on_words(self, operation: str, x: str, y: str) -> str:
        """Return what LLVM's operation makes of whole numbers."""
        return self.new(f"{operation} {self.words_type} {x}, {y}")

    def bits(self, x: str) -> str:
        """Return the bits of numbers as words."""
        return self.new(f"bitcast {self.numbers_type} {x} to {self.words_type}")

    def numbers(self, words: str) -> str:
        """Return the numbers of these bits."""
        return self.new(f"bitcast {self.words_type} {words} to {self.numbers_type}")

    def whole(self, x: str) -> str:
        """Return whole numbers as words."""
        return self.new(f"fptosi {self.numbers_type} {x} to {self.words_type}")

    def from_whole(self, words: str) -> str:
        """Return words as numbers."""
        return self.new(f"sitofp {self.words_type} {words} to {self.numbers_type}")

    def call(self, name: str, *operands: str) -> str:
        """Return a function of the processor's own, one of `INTRINSIC`: no call is left of it."""
        given = ", ".join(f"{self.numbers_type} {one}" for one in operands)
        return self.new(f"call {self.numbers_type} @llvm.{name}.v{self.count}f64({given})")

    def load(self, address: str, kind: str = "load") -> str:
        """Return the numbers at an address."""
        return self.new(f"{kind} {self.numbers_type}, ptr {address}, align {ALIGNED}")

    def store(self, value: str, address: str) -> None:
        """Write numbers to an address."""
        self.lines.append(f"store {self.numbers_type} {value}, ptr {address}, align {ALIGNED}")


INTRINSIC = {"fabs": 1, "sqrt": 1, "floor": 1, "fma": 3}
"""The processor's own functions, with the number of their arguments."""


def declared(count: int) -> str:
    """Return the lines of a module that uses them on vectors of `count` lanes."""
    numbers = f"<{count} x double>"
    return "\n".join(
        f"declare {numbers} @llvm.{name}.v{count}f64({', '.join([numbers] * arguments)})"
        for name, arguments in INTRINSIC.items()
    )


def mask(build: Builder, x: str) -> str:
    """Return bit k of eight for each lane k whose number is positive."""
    count = build.count
    where = build.greater(x, same(0.0))
    bits = build.new(f"bitcast <{count} x i1> {where} to i{count}")
    return bits if count == 8 else build.new(f"zext i{count} {bits} to i8")


def everywhere(build: Builder, number: str) -> str:
    """Return a number in every lane."""
    alone = build.new(f"insertelement {build.numbers_type} undef, double {number}, i32 0")
    return _shuffled(build, alone, alone, [0] * build.count)


def lower_and_upper(build: Builder, lower: str, upper: str) -> str:
    """Return the lower half of one and the upper half of the other."""
    count, half = build.count, build.count // 2
    return _shuffled(build, lower, upper, [*range(half), *range(count + half, 2 * count)])


def _shuffled(build: Builder, x: str, y: str, order: list[int]) -> str:
    chosen, numbers = ", ".join(f"i32 {one}" for one in order), build.numbers_type
    mask = f"<{build.count} x i32> <{chosen}>"
    return build.new(f"shufflevector {numbers} {x}, {numbers} {y}, {mask}")
