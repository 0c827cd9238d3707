"""Where functions of a device find what: numbers of a lane, and constants.

An address may be of any memory until it is said of which: most uses of it then take one instruction
more. A constant of more than 32 bits that is written out takes two, and one where it is read
from constant memory.
"""

import re

OWN = 'call ptr addrspace(5) asm "cvta.to.local.u64 $0, $1;", "=l,l"'
"""Says that an address is of the thread's own memory."""
CONSTANTS = "constants"
_ENTRY = "entry:"
_NUMBERS = re.compile(r"(ptr %[WS])\b")
_CONSTANT = re.compile(r"splat \(double 0x([0-9a-f]{16})\)")


def in_own_memory(function: str) -> str:
    """Return a function in LLVM's language whose numbers of lanes are in the thread's own memory.

    These are its arguments ``%W`` and ``%S``; loops have them there.
    """
    head, body = function.split(_ENTRY, 1)
    lines = [_NUMBERS.sub(r"\1.given", head) + _ENTRY]
    for argument in _NUMBERS.findall(head):
        name = argument.split()[1]
        lines.append(f"{name}.own = {OWN}({argument}.given)")
        lines.append(f"{name} = addrspacecast ptr addrspace(5) {name}.own to ptr")
    return "\n".join([*lines, body])


class Constants:
    """Constants of functions, in one array of constant memory."""

    def __init__(self) -> None:
        self._places: dict[str, int] = {}

    def read_in(self, function: str) -> str:
        """Return a function in LLVM's language that reads its constants; short ones stay in it."""
        head, body = function.split(_ENTRY, 1)
        used: dict[str, int] = {}

        def read(found: re.Match[str]) -> str:
            bits = found[1]
            if bits.endswith("00000000"):
                return found[0]
            used[bits] = self._places.setdefault(bits, len(self._places))
            return f"%constant{used[bits]}"

        # a choice between ways takes its values where these end
        lines = [one if " phi " in one else _CONSTANT.sub(read, one) for one in body.split("\n")]
        loads = [
            f"%constant{place} = load <1 x double>, ptr addrspace(4)"
            f" getelementptr (double, ptr addrspace(4) @{CONSTANTS}, i64 {place})"
            for place in used.values()
        ]
        return "\n".join([head + _ENTRY, *loads, *lines])

    def text(self) -> str:
        """Return the array; it might be set from outside, so that LLVM reads it, too."""
        numbers = ", ".join(f"double 0x{bits}" for bits in self._places)
        return (
            f"@{CONSTANTS} = internal addrspace(4) externally_initialized constant"
            f" [{len(self._places)} x double] [{numbers}]"
        )
