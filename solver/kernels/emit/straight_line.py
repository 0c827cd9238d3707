"""Writes a tape in the compiler's language: straight-line arithmetic over all lanes of work arrays.

A tape has one statement a line::

    v0 = load 12            slot 12 of W, all its lanes
    v0 = spread 12          slot 12 of W in one lane, the same at all instants
    v0 = spread 12 45       the same; slot 45 at the last four instants
    v0 = given 12           slot 12 of S
    v3 = mul v1 0.5         arithmetic: see `solver.kernels.trace.operations`
    store 14 v3             into slot 14 of S, or of W where there is no S
    return v3               bit k is set where lane k is positive

Where S is written, its columns are eight instants of one lane's step, however many lanes there are:
the tape is run for as many instants at a time as there are lanes.

A tape for one of many rows has slots that move with the row, and one for all of them tells where
something is positive::

    v0 = load 12+           slot 12 + row
    mark 14 v3              byte `row` of slot 14 and those behind it: bit k is set where lane k is
    where v3                what follows is done if it is positive in any lane; else no bit is set

What few lanes need is evaluated only where one does::

    if v3                   what follows, up to the end, is done if v3 is positive in any lane
    end
    v5 = either v4 v2       v4, which was made in between, if that was done, else v2

A step is a tape that calls others of its module, and has equations solved::

    call stage_2            a function of W
    call slopes 42          a function of W and a row
    return call judge       its value
    jacobian 6 0.25 2 42    see `solver.kernels.emit.elimination`
    solve 6 42

As Python's arithmetic in a loop over the lanes, which Numba compiled, it took five times as long to
compile and ran no faster.
"""

from collections.abc import Callable, Sequence

from jointplay.solver.kernels.emit.elimination import factorise, substitute
from jointplay.solver.kernels.emit.lane_arithmetic import (
    Builder,
    everywhere,
    lower_and_upper,
    mask,
    same,
)
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.trace.operations import OPERATIONS

ARGUMENTS: dict[str, dict[str, str]] = {
    "lanes": {"%W": "ptr"},
    "instants": {"%W": "ptr", "%S": "ptr", "%index": "i64"},
    "row": {"%W": "ptr", "%index": "i64"},
    "rows": {"%W": "ptr"},
}
"""Arguments of a function and their types, by what its tape goes over."""

WRITTEN_OVER = "load volatile"
"""Instruction that loads slots which a tape writes, too: mostly some lanes keep what is there. Of
that, LLVM would make a store into the other lanes alone, which takes AMD's processors with vectors
of 256 bits so long that a step took a tenth longer. It leaves volatile loads as they are."""

Symbol = Callable[[str], str]
"""Gives the name by which LLVM knows a function of the module."""


def write(
    tape: Sequence[str], over: str, rows: int, value: str, symbol: Symbol, count: int
) -> list[str]:
    """Return the lines of a function that does what a tape says.

    Parameters
    ----------
    over
        ``lanes``: all, of W alone. ``instants``: those inside the step of the lane of this index,
        written to S. ``row``: all lanes, in the row of this index. ``rows``: the same for each
        row; the value tells which lanes were marked in any, bit k for lane k.
    rows
        Number of rows. They are a loop: written out, they would push everything else that a step
        does out of the cache of instructions.
    value
        Type of the function's value.
    symbol
        How functions are called that the tape calls.
    count
        Number of lanes.
    """
    build, parts = Builder(count), INSTANTS // count
    if over == "rows":
        build.lines += ["%marks = alloca i8", "store i8 0, ptr %marks"]
        with build.loop("0", str(rows)) as row:
            _Tape(build, symbol, row=row).run(tape)
        found = build.new("load i8, ptr %marks")
        build.lines.append(f"ret i64 {build.new(f'zext i8 {found} to i64')}")
    elif over == "instants" and parts > 1:
        with build.loop("0", str(parts)) as part:
            _Tape(build, symbol, target="%S", part=part).run(tape)
    elif over == "instants":
        _Tape(build, symbol, target="%S").run(tape)
    else:
        _Tape(build, symbol, row="%index").run(tape)
    if value == "void":
        build.lines.append("ret void")
    return build.lines


class _Tape:
    """The arrays that a tape works on, and the values that it has made so far."""

    def __init__(
        self, build: Builder, symbol: Symbol, *, target: str = "%W", row: str = "", part: str = ""
    ) -> None:
        self.build, self.symbol = build, symbol
        self.target, self.row, self.part = target, row, part
        self.values: dict[str, str] = {}
        self.ways: list[str] = []
        self.written: set[str] = set()
        """Slots."""

    def run(self, lines: Sequence[str]) -> None:
        """Write the code of a tape's lines."""
        self.written |= {line.split()[1] for line in lines if line.startswith("store ")}
        for i, line in enumerate(lines):
            words = line.split()
            if words[0] == "where":
                with self.build.where(self._value(words[1])):
                    self.run(lines[i + 1 :])
                return
            if words[0] == "if":
                end = lines.index("end")
                with self.build.where(self._value(words[1])) as self.ways:
                    self.run(lines[i + 1 : end])
                self.run(lines[end + 1 :])
                return
            if words[1] == "=":
                self.values[words[0]] = self._made(*words[2:])
            else:
                self._do(words)

    def _made(self, what: str, *operands: str) -> str:
        """Write a value."""
        if what == "load":
            return self._load("%W", *operands)
        if what == "given":
            return self._load(self.target, *operands)
        if what == "spread":
            return self._spread(*operands)
        if what == "either":
            return self.build.either(self.ways, *map(self._value, operands))
        on_lanes = OPERATIONS[what].on_lanes
        assert on_lanes is not None  # noqa: S101  (tapes have no others)
        return on_lanes(self.build, *map(self._value, operands))

    def _do(self, words: list[str]) -> None:
        """Write what is no value."""
        build = self.build
        match words:
            case ["store", slot, value]:
                build.store(self._value(value), self._place(self.target, slot))
            case ["mark", slot, value]:
                self._mark(slot, self._value(value))
            case ["return", "call", name]:
                build.lines.append(f"ret i64 {build.new(f'call i64 {self.symbol(name)}(ptr %W)')}")
            case ["return", value]:
                found = mask(build, self._value(value))
                build.lines.append(f"ret i64 {build.new(f'zext i8 {found} to i64')}")
            case ["call", name]:
                build.lines.append(f"call void {self.symbol(name)}(ptr %W)")
            case ["call", name, row]:
                build.lines.append(f"call void {self.symbol(name)}(ptr %W, i64 {row})")
            case ["jacobian", *numbers]:
                factorise(build, self.symbol("product"), *numbers)
            case ["solve", *numbers]:
                substitute(build, *numbers)

    def _value(self, text: str) -> str:
        return self.values[text] if text in self.values else same(float(text))

    def _load(self, array: str, slot: str) -> str:
        over = self.build.count > 1 and array == self.target and slot in self.written
        return self.build.load(self._place(array, slot), WRITTEN_OVER if over else "load")

    def _mark(self, slot: str, value: str) -> None:
        build, bits = self.build, mask(self.build, value)
        marked = build.new("load i8, ptr %marks")
        build.lines.append(f"store i8 {build.new(f'or i8 {marked}, {bits}')}, ptr %marks")
        first = self._place(self.target, slot)
        address = build.new(f"getelementptr i8, ptr {first}, i64 {self.row}")
        build.lines.append(f"store i8 {bits}, ptr {address}")

    def _spread(self, slot: str, later_slot: str = "") -> str:
        build, early = self.build, self._spread_one(slot)
        if not later_slot:
            return early
        late = self._spread_one(later_slot)
        if not self.part:
            return lower_and_upper(build, early, late)
        is_early = build.new(f"icmp ult i64 {self.part}, {INSTANTS // build.count // 2}")
        numbers = build.numbers_type
        return build.new(f"select i1 {is_early}, {numbers} {early}, {numbers} {late}")

    def _place(self, array: str, slot: str) -> str:
        offset = slot.removesuffix("+")
        if slot.endswith("+"):
            offset = self.build.new(f"add i64 {offset}, {self.row}")
        if self.part:  # only S is loaded from or stored to
            whole = self.build.new(f"mul i64 {offset}, {INSTANTS // self.build.count}")
            offset = self.build.new(f"add i64 {whole}, {self.part}")
        return self.build.new(f"getelementptr {self.build.numbers_type}, ptr {array}, i64 {offset}")

    def _spread_one(self, slot: str) -> str:
        offset = self.build.new(f"add i64 {int(slot) * self.build.count}, %index")
        address = self.build.new(f"getelementptr double, ptr %W, i64 {offset}")
        return everywhere(self.build, self.build.new(f"load double, ptr {address}"))
