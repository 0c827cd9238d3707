"""Writes a tape in the compiler's language: straight-line arithmetic over all lanes of work arrays.

A tape has one statement a line::

    v0 = load 12            slot 12 of W, all its lanes
    v0 = spread 12          slot 12 of W in one lane, the same at all instants
    v0 = spread 12 45       the same; slot 45 at the last four instants
    v0 = given 12           slot 12 of S
    v3 = mul v1 0.5         arithmetic: see `solver.kernels.record.operations`
    store 14 v3             into slot 14 of S, or of W where there is no S
    return v3               the largest of its lanes

Where S is written, its columns are eight instants of one lane's step, however many lanes there are:
the tape is run for as many instants at a time as there are lanes.

A tape for one of many rows has slots that move with the row, and one for all of them tells where
something is positive::

    v0 = load 12+           slot 12 + row
    mark 14 v3              byte `row` of slot 14 and those behind it: bit k is set where lane k is

As Python's arithmetic in a loop over the lanes, which it was once, the types of a thousand scalars
had to be inferred and the loop found to be one of vectors: it took five times as long to compile
and ran no faster.
"""

# mypy: disable-error-code="no-untyped-def,no-untyped-call,misc"

from __future__ import annotations

from typing import Any

from numba.core import cgutils

from jointplay.solver.kernels.emit.lane_arithmetic import (
    MARKS,
    NUMBERS,
    WORD,
    Lanes,
    everywhere,
    largest,
    lower_and_upper,
    positive,
    same,
)
from jointplay.solver.kernels.lanes import LANES
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.record.operations import OPERATIONS

PARTS = INSTANTS // LANES
"""Halves, or the whole, of the instants."""
ALIGNED = 8
"""Bytes that an address is surely a multiple of; `kernels.loop.bundle` has arrays begin on 64."""


def write(
    tape: str, builder: Any, over: str, rows: int, source: Any, target: Any, index: Any
) -> Any:
    """Generate what a tape says; the function's value, None where it has none.

    Parameters
    ----------
    over
        ``lanes``: all, of W alone. ``instants``: those inside the step of the lane of this index,
        written to S. ``row``: all lanes, in the row of this index. ``rows``: the same for each
        row; the value tells which lanes were marked in any, bit k for lane k.
    rows
        Number of rows. They are a loop: written out, they would push everything else that a step
        does out of the cache of instructions.
    source, target
        Where numbers are loaded from, and where they are stored.
    """
    if over == "rows":
        marks = cgutils.alloca_once_value(builder, MARKS(0))
        with cgutils.for_range(builder, WORD(rows)) as loop:
            _run(tape, _Tape(builder, source, target, row=loop.index, marks=marks))
        return builder.zext(builder.load(marks), WORD)
    if over == "instants" and PARTS > 1:
        with cgutils.for_range(builder, WORD(PARTS)) as loop:
            _run(tape, _Tape(builder, source, target, lane=index, part=loop.index))
        return None
    return _run(tape, _Tape(builder, source, target, lane=index, row=index))


def _run(tape: str, state: _Tape) -> Any:
    """Generate the code of a tape's lines; the value that it returns."""
    for line in tape.strip().splitlines():
        match line.replace("= ", "").split():
            case ["store", slot, value]:
                state.store(slot, state.value(value))
            case ["mark", slot, value]:
                state.mark(slot, state.value(value))
            case ["return", value]:
                return largest(state.builder, state.value(value))
            case [name, "load", slot]:
                state.values[name] = state.load(state.source, slot)
            case [name, "given", slot]:
                state.values[name] = state.load(state.target, slot)
            case [name, "spread", *slots]:
                state.values[name] = state.spread(*slots)
            case [name, operation, *operands]:
                values = map(state.value, operands)
                state.values[name] = OPERATIONS[operation].on_lanes(state.lanes, *values)
    return None


class _Tape:
    """The arrays that a tape works on, and the values that it has made so far."""

    def __init__(
        self, builder, source, target, *, lane=None, row=None, marks=None, part=None
    ) -> None:
        self.builder, self.numbers = builder, source
        kind = NUMBERS.as_pointer()
        self.source, self.target = (builder.bitcast(array, kind) for array in (source, target))
        self.lanes = Lanes(builder)
        self.lane, self.row, self.marks, self.part = lane, row, marks, part
        self.values: dict[str, Any] = {}

    def value(self, text: str) -> Any:
        return self.values[text] if text in self.values else same(float(text))

    def load(self, array: Any, slot: str) -> Any:
        return self.builder.load(self._place(array, slot), align=ALIGNED)

    def store(self, slot: str, value: Any) -> None:
        self.builder.store(value, self._place(self.target, slot), align=ALIGNED)

    def mark(self, slot: str, value: Any) -> None:
        builder, bits = self.builder, positive(self.builder, value)
        builder.store(builder.or_(builder.load(self.marks), bits), self.marks)
        rows = builder.bitcast(self._place(self.target, slot), MARKS.as_pointer())
        builder.store(bits, builder.gep(rows, [self.row]))

    def spread(self, slot: str, later_slot: str = "") -> Any:
        builder, early = self.builder, self._spread(slot)
        if not later_slot:
            return early
        late = self._spread(later_slot)
        if self.part is None:
            return lower_and_upper(builder, early, late)
        return builder.select(self._is_early(), early, late)

    def _is_early(self) -> Any:
        return self.builder.icmp_unsigned("==", self.part, WORD(0))

    def _place(self, array: Any, slot: str) -> Any:
        place = WORD(int(slot.removesuffix("+")))
        if slot.endswith("+"):
            place = self.builder.add(place, self.row)
        if self.part is not None:  # only S is loaded from or stored to
            place = self.builder.add(self.builder.mul(place, WORD(PARTS)), self.part)
        return self.builder.gep(array, [place])

    def _spread(self, slot: str) -> Any:
        place = self.builder.add(WORD(int(slot) * LANES), self.lane)
        number = self.builder.load(self.builder.gep(self.numbers, [place]))
        return everywhere(self.builder, number)
