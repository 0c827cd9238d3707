"""The processor in the place of a device and its driver: to try without a card what needs one.

It has the functions of `libcuda` that `driver` calls, memory of its own, and runs a kernel's text
lane by lane.
"""

import ctypes
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from jointplay.solver.kernels.device.compiled import host_code
from jointplay.solver.kernels.device.driver import PROCESSORS, RATIO
from jointplay.solver.kernels.device.kernel_text import PARTS

OUT_OF_MEMORY, LOST = 2, 719
NAMES = {OUT_OF_MEMORY: b"CUDA_ERROR_OUT_OF_MEMORY", LOST: b"CUDA_ERROR_LAUNCH_FAILED"}
ATTRIBUTES = {PROCESSORS: 1, RATIO: 2}
OPENING = ("cuInit", "cuDeviceGet", "cuDevicePrimaryCtxRetain", "cuCtxSetCurrent")
NOTHING = (*OPENING, "cuCtxSynchronize")
"""Functions that have nothing to do here."""
MEMORY = 2**30
"""Bytes."""
FAILING = "JOINTPLAY_HOST_FAILS"
"""Variable that may name a file; while that says one of these words, the device fails so."""
FAILURES: Mapping[str, int] = {"lost": LOST, "memory": OUT_OF_MEMORY}


class HostDriver:
    """Functions of the driver by their names; code is a kernel's text for a host."""

    def __init__(self, memory: int = MEMORY) -> None:
        """Have so many bytes of memory."""
        self.memory, self.held = memory, dict[int, Any]()
        self._engines: list[Any] = []

    def __getattr__(self, name: str) -> Any:
        """Return what does nothing, for functions that open a device or wait for it."""
        if name in NOTHING:
            return lambda *_: 0
        raise AttributeError(name)

    def cuGetErrorName(self, code: int, said: Any) -> int:  # noqa: N802
        """Give the name of a code."""
        said._obj.value = NAMES[code]
        return 0

    def cuDeviceGetName(self, said: Any, _size: int, _device: Any) -> int:  # noqa: N802
        """Give the name of the device."""
        said.value = b"this processor"
        return 0

    def cuDeviceGetAttribute(self, value: Any, which: int, _device: Any) -> int:  # noqa: N802
        """Give how many multiprocessors there are, or how fast double precision is."""
        value._obj.value = ATTRIBUTES[which]
        return 0

    def cuMemAlloc_v2(self, address: Any, size: Any) -> int:  # noqa: N802
        """Take memory, in which is what others left."""
        if failure := _failure():
            return failure
        if sum(one.nbytes for one in self.held.values()) + size.value > self.memory:
            return OUT_OF_MEMORY
        held = np.full(size.value, 255, np.uint8)  # what is left over from others
        address._obj.value = held.ctypes.data
        self.held[held.ctypes.data] = held
        return 0

    def cuMemFree_v2(self, address: Any) -> int:  # noqa: N802
        """Give memory back."""
        del self.held[address.value]
        return 0

    def cuMemcpyHtoD_v2(self, address: Any, source: Any, size: Any) -> int:  # noqa: N802
        """Copy to the device."""
        ctypes.memmove(address.value, source.value, size.value)
        return 0

    def cuMemcpy2DUnaligned_v2(self, given: Any) -> int:  # noqa: N802
        """Copy rows of bytes from the device."""
        copy = given._obj
        for row in range(copy.height):
            source = copy.source_device + row * copy.source_pitch + copy.source_x
            ctypes.memmove(copy.target_host + row * copy.target_pitch, source, copy.width)
        return 0

    def cuModuleLoadDataEx(self, module: Any, code: bytes, *_: Any) -> int:  # noqa: N802
        """Make code of a text."""
        self._engines.append(host_code(code.rstrip(b"\0").decode()))
        module._obj.value = len(self._engines)
        return 0

    def cuModuleGetFunction(self, function: Any, module: Any, name: bytes) -> int:  # noqa: N802
        """Give a kernel of the code."""
        function._obj.value = self._engines[module.value - 1].get_function_address(
            PARTS[name.decode()]
        )
        return 0

    def cuFuncGetAttribute(self, value: Any, _which: int, _function: Any) -> int:  # noqa: N802
        """Give that a kernel needs nothing."""
        value._obj.value = 0
        return 0

    def cuLaunchKernel(  # noqa: N802
        self, function: Any, blocks: int, _y: int, _z: int, threads: int, *rest: Any
    ) -> int:
        """Run a kernel, thread by thread."""
        if failure := _failure():
            return failure
        given = rest[4]
        words = [ctypes.c_uint64.from_address(given[k]).value for k in range(8)]
        kind = ctypes.CFUNCTYPE(None, *[ctypes.c_uint64] * 9)
        for lane in range(min(blocks * threads, words[6])):
            kind(function.value)(*words, lane)
        return 0


def _failure() -> int:
    """Return the code of how the device fails now; 0: it does not."""
    file = os.environ.get(FAILING)
    try:
        return FAILURES.get(Path(file).read_text().strip(), 0) if file else 0
    except OSError:
        return 0
