"""Writes the statements of a tape as operations on vectors; see `straight_line`."""

# mypy: disable-error-code="no-untyped-def,no-untyped-call,misc"

from typing import Any

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


class Writer:
    """The arrays that a tape works on, and the values that it has made so far."""

    def __init__(self, builder, source, target, index, *, marks=None, part=None, kept=None) -> None:
        """`index` : of the lane whose step it is, or of the row."""
        self.builder, self.source, self.target = builder, source, target
        self.lanes = Lanes(builder)
        self.index, self.marks, self.part, self.kept = index, marks, part, kept
        self.values: dict[str, Any] = {}

    def write(self, lines: list[str]) -> Any:
        """Generate the code of lines; the value that they return."""
        for line in lines:
            match line.replace("= ", "").split():
                case ["store", slot, value]:
                    self._store(slot, self._value(value))
                case ["mark", slot, value]:
                    self._mark(slot, self._value(value))
                case ["return", value]:
                    return largest(self.builder, self._value(value))
                case ["keep", place, value]:
                    self._keep(place, self._value(value))
                case [name, "load" | "given" | "kept" as kind, slot]:
                    self.values[name] = self._load(kind, slot)
                case [name, "spread", *slots]:
                    self.values[name] = self._spread(*slots)
                case [name, operation, *operands]:
                    values = map(self._value, operands)
                    self.values[name] = OPERATIONS[operation].on_lanes(self.lanes, *values)
        return None

    def _value(self, text: str) -> Any:
        return self.values[text] if text in self.values else same(float(text))

    def _load(self, kind: str, slot: str) -> Any:
        if kind == "kept":
            return self.builder.load(self._kept_at(slot))
        array = self.source if kind == "load" else self.target
        return self.builder.load(self._place(array, slot), align=ALIGNED)

    def _store(self, slot: str, value: Any) -> None:
        self.builder.store(value, self._place(self.target, slot), align=ALIGNED)

    def _keep(self, place: str, value: Any) -> None:
        self.builder.store(value, self._kept_at(place))

    def _mark(self, slot: str, value: Any) -> None:
        builder, bits = self.builder, positive(self.builder, value)
        builder.store(builder.or_(builder.load(self.marks), bits), self.marks)
        rows = builder.bitcast(self._place(self.target, slot), MARKS.as_pointer())
        builder.store(bits, builder.gep(rows, [self.index]))

    def _spread(self, slot: str, later_slot: str = "") -> Any:
        builder, early = self.builder, self._everywhere(slot)
        if not later_slot:
            return early
        late = self._everywhere(later_slot)
        if self.part is None:
            return lower_and_upper(builder, early, late)
        return builder.select(self._is_early(), early, late)

    def _is_early(self) -> Any:
        return self.builder.icmp_unsigned("==", self.part, WORD(0))

    def _place(self, array: Any, slot: str) -> Any:
        place = WORD(int(slot.removesuffix("+")))
        if slot.endswith("+"):
            place = self.builder.add(place, self.index)
        if self.part is not None:  # only S is loaded from or stored to
            place = self.builder.add(self.builder.mul(place, WORD(PARTS)), self.part)
        return self.builder.gep(self.builder.bitcast(array, NUMBERS.as_pointer()), [place])

    def _kept_at(self, place: str) -> Any:
        return self.builder.gep(self.kept, [WORD(int(place))])

    def _everywhere(self, slot: str) -> Any:
        place = self.builder.add(WORD(int(slot) * LANES), self.index)
        number = self.builder.load(self.builder.gep(self.source, [place]))
        return everywhere(self.builder, number)
