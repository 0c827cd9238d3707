"""Compiles a tape: straight-line arithmetic over all lanes of work arrays.

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

A long tape is cut into `pieces`, each a function of its own.

As Python's arithmetic in a loop over the lanes, which it was once, the types of a thousand scalars
had to be inferred and the loop found to be one of vectors: it took five times as long to compile
and ran no faster.
"""

# mypy: disable-error-code="no-untyped-def,no-untyped-call,misc"

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import float64, int64, types
from numba.core import cgutils
from numba.extending import intrinsic

from jointplay.solver.kernels.emit.lane_arithmetic import DOUBLE, MARKS, NUMBERS, WORD
from jointplay.solver.kernels.emit.pieces import LONGEST, cut
from jointplay.solver.kernels.emit.writer import PARTS, Writer


def straight_line(tape: str, over: str, rows: int = 0, longest: int = LONGEST) -> Any:
    """Return a function of W, S and an index, inside kernels, that does what the tape says.

    Parameters
    ----------
    over
        ``lanes``: all, of W alone. ``instants``: those inside the step of the lane of this index,
        written to S. ``row``: all lanes, in the row of this index. ``rows``: the same for each
        row; the value tells which lanes were marked in any, bit k for lane k.
    rows
        Number of rows. They are a loop: written out, they would push everything else that a step
        does out of the cache of instructions.
    longest
        Statements that are compiled as one block.
    """
    value = {"rows": int64}.get(over, float64 if "\nreturn " in tape else types.void)

    @intrinsic
    def run(_typing, W, S, index):  # noqa: N803  (as in every generated kernel)
        def generate(context, builder, signature, arguments):
            pieces = cut(tape.strip().splitlines(), longest)
            source, target = (
                context.make_array(signature.args[i])(context, builder, value=arguments[i]).data
                for i in (0, 1 if over == "instants" else 0)
            )
            if over == "rows":
                marks = cgutils.alloca_once_value(builder, MARKS(0))
                with cgutils.for_range(builder, WORD(rows)) as loop:
                    _run(pieces, Writer(builder, source, target, loop.index, marks=marks))
                return builder.zext(builder.load(marks), WORD)
            if over == "instants" and PARTS > 1:
                with cgutils.for_range(builder, WORD(PARTS)) as loop:
                    _run(pieces, Writer(builder, source, target, arguments[2], part=loop.index))
                return context.get_dummy_value()
            writer = Writer(builder, source, target, arguments[2])
            return _run(pieces, writer) or context.get_dummy_value()

        return value(W, S, index), generate

    return run


def _run(cut_tape: tuple[list[list[str]], int], writer: Writer) -> Any:
    """Generate the code of a tape, a long one in pieces; the value that it returns."""
    pieces, places = cut_tape
    if len(pieces) == 1:
        return writer.write(pieces[0])
    kept = cgutils.alloca_once(writer.builder, NUMBERS, size=WORD(max(places, 1)))
    values = [_call(piece, writer, kept) for piece in pieces]
    return values[-1]


def _call(piece: list[str], writer: Writer, kept: Any) -> Any:
    """Generate a function of a piece and a call of it; the value that it returns."""
    outer = {"source": writer.source, "target": writer.target, "index": writer.index, "kept": kept}
    if writer.part is not None:
        outer["part"] = writer.part
    value = DOUBLE if piece[-1].startswith("return") else ir.VoidType()
    kind = ir.FunctionType(value, [argument.type for argument in outer.values()])
    module = writer.builder.module
    function = ir.Function(module, kind, module.get_unique_name("piece"))
    function.linkage = "internal"
    function.attributes.add("noinline")
    inner = dict(zip(outer, function.args, strict=True))
    inner["kept"].add_attribute("noalias")
    builder = ir.IRBuilder(function.append_basic_block())
    result = Writer(builder, **inner).write(piece)
    called = writer.builder.call(function, outer.values())
    if result is None:
        builder.ret_void()
        return None
    builder.ret(result)
    return called
