"""Generated functions of a kernel as loops call them: ``generated.take(addresses, work)``.

Each takes the structure of the addresses (see `solver.kernels.emit.functions`), and then what the
function does, of which it is given the address of an array's numbers.
"""

# mypy: disable-error-code="no-untyped-def,no-untyped-call,misc"

from typing import Any, cast

from llvmlite import ir
from numba import int64, void
from numba.core import cgutils
from numba.extending import intrinsic

from jointplay.solver.kernels.emit.functions import (
    ARRAY,
    MARKING,
    OVER_LANES,
    SIGNATURES,
    Signature,
)

VALUES = {"void": void, "i64": int64}
WORD = cgutils.intp_t


def _written(name: str, signature: Signature, structure: Any, arguments: tuple[Any, ...]) -> Any:
    """Return what Numba asks of an intrinsic: its signature, and what writes the call."""
    value = VALUES[signature.value]

    def generate(context, builder, types, values):
        place = cgutils.get_record_member(builder, values[0], structure.offset(name), WORD)
        given = [
            context.make_array(kind)(context, builder, value=one).data if wanted == ARRAY else one
            for wanted, kind, one in zip(
                signature.arguments, types.args[1:], values[1:], strict=True
            )
        ]
        kinds = [one.type for one in given]
        answer = ir.VoidType() if value == void else WORD
        address = builder.load(place)
        function = builder.inttoptr(address, ir.FunctionType(answer, kinds).as_pointer())
        called = builder.call(function, given)
        return context.get_dummy_value() if value == void else called

    return value(structure, *arguments), generate


def _of(name: str) -> Any:
    """Return the intrinsic that calls a function of a kernel."""
    expected = SIGNATURES[name]
    if expected in (OVER_LANES, MARKING):

        def call(_typing, structure, work):
            return _written(name, expected, structure, (work,))

    else:

        def call(_typing, structure, work, spare, lane):
            return _written(name, expected, structure, (work, spare, lane))

    call.__name__ = name
    return cast(Any, intrinsic(call))


right_hand_side = _of("right_hand_side")
attempt = _of("attempt")
remember = _of("remember")
remember_some = _of("remember_some")
take = _of("take")
weigh = _of("weigh")
observe = _of("observe")
observe_rest = _of("observe_rest")
foresee_looks = _of("foresee_looks")
foresee_bends = _of("foresee_bends")
scan = _of("scan")
scan_some = _of("scan_some")
states_within = _of("states_within")
penetrations_within = _of("penetrations_within")
channels_within = _of("channels_within")
channels_around = _of("channels_around")
tangent_step = _of("tangent_step")
tangent_penetrations = _of("tangent_penetrations")
