"""The kernel of a device in LLVM's language: tapes for one lane, and what has the loop run."""

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.kernels.device.address_spaces import Constants, in_own_memory
from jointplay.solver.kernels.device.lanes import ENTRY, MOVE, Sizes
from jointplay.solver.kernels.device.one_lane import GlobalMemory
from jointplay.solver.kernels.emit import functions
from jointplay.solver.kernels.emit.lane_arithmetic import declared
from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop import runs
from jointplay.solver.kernels.loop_library import ARITHMETIC

LOOP, LANE, MEET = "one_lane", "lane", "meet"
"""Names of functions: the loop, a lane's part of a launch, and where threads of a block meet,
attempt by attempt: they share what they fetch of the code."""
MOVE_ONE = "move_one"
"""A thread's part of what brings numbers of some lanes together, or back to them."""
PARTS = {ENTRY: LANE, MOVE: MOVE_ONE}
"""A thread's part of each kernel: a function with one word more, the thread's number."""
CALLED = ("states_within", "penetrations_within", "weigh", "tangent_penetrations")
"""Functions that are called now and then: written in where they are called, they would fill the
cache of instructions."""
LIBRARY = f"""
define void @NRT_incref(ptr %x) alwaysinline nounwind {{ ret void }}
define void @NRT_decref(ptr %x) alwaysinline nounwind {{ ret void }}
{ARITHMETIC}"""
"""Functions that the loop calls: references are not counted here."""
PARAMETERS = ", ".join(
    [*(f"ptr %{name}" for name in GlobalMemory._fields), "i64 %size.lanes", "i64 %budget"]
)
"""Those of the kernel, and, with the lane behind them, of the lane's part."""
MOVE_PARAMETERS = (
    "ptr %columns, ptr %packed, ptr %which, i64 %along, i64 %across, i64 %chosen, i64 %size,"
    " i64 %into"
)
"""Numbers of all lanes, (slots, lanes) in steps of so many words along slots and across lanes;
those of chosen lanes, (slots, chosen), `size` in all; which lanes these are; not 0: into lanes."""
MOVED = f"""
define void @{MOVE_ONE}({MOVE_PARAMETERS}, i64 %index) alwaysinline nounwind {{
  %slot = udiv i64 %index, %chosen
  %k = urem i64 %index, %chosen
  %choice = getelementptr i64, ptr %which, i64 %k
  %lane = load i64, ptr %choice
  %far = mul i64 %slot, %along
  %aside = mul i64 %lane, %across
  %place = add i64 %far, %aside
  %own = getelementptr i64, ptr %columns, i64 %place
  %other = getelementptr i64, ptr %packed, i64 %index
  %inward = icmp ne i64 %into, 0
  %source = select i1 %inward, ptr %other, ptr %own
  %target = select i1 %inward, ptr %own, ptr %other
  %word = load i64, ptr %source
  store i64 %word, ptr %target
  ret void
}}
"""
ON_DEVICE = f"""
declare i32 @llvm.nvvm.read.ptx.sreg.tid.x()
declare i32 @llvm.nvvm.read.ptx.sreg.ctaid.x()
declare i32 @llvm.nvvm.read.ptx.sreg.ntid.x()
define void @{MEET}() alwaysinline convergent nounwind {{
  call void asm sideeffect "barrier.sync 0;", ""() convergent
  ret void
}}
"""
ON_HOST = f"define void @{MEET}() alwaysinline nounwind {{ ret void }}\n"


def kernel_text(
    sources: Sequence[Source], slots: NDArray[np.void], sizes: Sizes, *, on_host: bool
) -> str:
    """Return all but the loop, which `LOOP` stands for.

    Parameters
    ----------
    sources
        Of the kernel, and of its tangents if lanes have some.
    slots
        Of the kernel, or of its tangents.
    sizes
        What a lane has. The number of lanes is known when they are launched.
    on_host
        For this processor, whose `LANE` does what a thread of the device does.
    """
    return "\n".join(
        [
            declared(1),
            LIBRARY,
            *_functions(sources, on_host=on_host),
            _words("slots", [f"i64 {word}" for word in slots.view(np.int64).reshape(-1)]),
            _lane(sizes, spare_rows(sources, sizes.slots) * INSTANTS),
            MOVED,
            *([ON_HOST] if on_host else [ON_DEVICE, _kernel(ENTRY), _kernel(MOVE)]),
        ]
    )


def _kernel(name: str) -> str:
    """Return a kernel, whose threads do its part as often as its seventh word says."""
    given = {ENTRY: PARAMETERS, MOVE: MOVE_PARAMETERS}[name]
    count = given.split(", ")[6].split()[1]
    return f"""
define ptx_kernel void @{name}({given}) {{
  %thread = call i32 @llvm.nvvm.read.ptx.sreg.tid.x()
  %block = call i32 @llvm.nvvm.read.ptx.sreg.ctaid.x()
  %threads = call i32 @llvm.nvvm.read.ptx.sreg.ntid.x()
  %before = mul i32 %block, %threads
  %sum = add i32 %before, %thread
  %index = zext i32 %sum to i64
  %there = icmp slt i64 %index, {count}
  br i1 %there, label %go, label %end
go:
  call void @{PARTS[name]}({given}, i64 %index)
  br label %end
end:
  ret void
}}
"""


def spare_rows(sources: Sequence[Source], slots: int) -> int:
    """Return how many rows of `spare` are used: those that instants are written to.

    All of a lane's numbers have room there, too: see `loop.contacts.begin_abruptly`.
    """
    within = [one for one in sources if one.name in ("states_within", "penetrations_within")]
    words = (line.split() for one in within for line in one.lines)
    used = {int(w[1] if w[0] == "store" else w[3]) for w in words if {"store", "given"} & {*w}}
    return max(*used, -(-slots // INSTANTS)) + 1


def _functions(sources: Sequence[Source], *, on_host: bool) -> Iterator[str]:
    """Yield the text of all functions, and of a structure that has them as the loop finds them."""
    there, constants = {one.name for one in sources}, Constants()
    for one in sources:
        how = "noinline" if one.name in CALLED else "alwaysinline"
        text = constants.read_in(one.function_text(_symbol, 1, f"{how} nounwind"))
        yield text if on_host else in_own_memory(text)
        if one.name in functions.SIGNATURES:
            meeting = [f"call void @{MEET}()"] if one.name == "attempt" else []
            yield one.called_by_loops(_symbol, meeting)
    addresses = [
        f"i64 ptrtoint (ptr {_symbol(name + functions.COUNTED)} to i64)"
        if name in there
        else "i64 0"
        for name in functions.SIGNATURES
    ]
    yield _words("functions", addresses)
    yield constants.text()


def _symbol(name: str) -> str:
    return f'@"{name}"'


def _words(name: str, words: Sequence[str]) -> str:
    return f"@{name} = internal constant [{len(words)} x i64] [{', '.join(words)}]"


def _lane(sizes: Sizes, spare: int) -> str:
    """Return the function that gives a thread room and has the loop run."""
    given = ", ".join(
        [
            "ptr %value, ptr %failure, ptr @functions, ptr @slots",
            *(f"ptr %{name}" for name in GlobalMemory._fields),
            "ptr %work, ptr %spare, ptr %run, i64 %size.lanes",
            *(f"i64 {size}" for size in sizes[1:]),
            "i64 %lane, i64 %budget",
        ]
    )
    return f"""
declare i32 @{LOOP}({", ".join(one.split()[0] for one in given.split(", "))})
define void @{LANE}({PARAMETERS}, i64 %lane) alwaysinline nounwind {{
  %work = alloca [{sizes.slots} x double], align 16
  %spare = alloca [{spare} x double], align 16
  %run = alloca [{runs.DTYPE.itemsize // 8} x i64], align 16
  %value = alloca i64
  %failure = alloca [4 x ptr]
  %code = call i32 @{LOOP}({given}) alwaysinline
  ret void
}}
"""
