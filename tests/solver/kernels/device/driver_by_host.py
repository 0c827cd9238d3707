"""Stands for `libcuda`: memory of its own, and a kernel that this processor runs lane by lane."""

import ctypes
from typing import Any

import numpy as np

from jointplay.solver.kernels.device.compiled import host_code
from jointplay.solver.kernels.device.driver import ON_DEVICE, _Copy
from jointplay.solver.kernels.device.kernel_text import PARTS

OUT_OF_MEMORY, NOT_FOUND, LOST = 2, 500, 719
NAMES = {
    OUT_OF_MEMORY: b"CUDA_ERROR_OUT_OF_MEMORY",
    NOT_FOUND: b"CUDA_ERROR_NOT_FOUND",
    LOST: b"CUDA_ERROR_LAUNCH_FAILED",
}


class DriverByHost:
    """Functions of the driver by their names; code is a kernel's text for a host."""

    def __init__(self, memory: int = 2**30) -> None:
        self.memory, self.held = memory, dict[int, Any]()
        self.launches = 0
        self.fetched = 0
        """Bytes that were copied from the device."""
        self.lost_at = -1
        """Number of the launch at which the device is lost."""
        self._lane: Any = None
        self._engines: list[Any] = []

    def __getattr__(self, name: str) -> Any:
        if name in ("cuInit", "cuDeviceGet", "cuDevicePrimaryCtxRetain", "cuCtxSetCurrent"):
            return lambda *_: 0
        raise AttributeError(name)

    def cuGetErrorName(self, code: int, said: Any) -> int:  # noqa: N802
        said._obj.value = NAMES[code]
        return 0

    def cuDeviceGetName(self, said: Any, _size: int, _device: Any) -> int:  # noqa: N802
        said.value = b"this processor"
        return 0

    def cuDeviceGetAttribute(self, value: Any, which: int, _device: Any) -> int:  # noqa: N802
        value._obj.value = {16: 2, 87: 2}[which]
        return 0

    def cuMemGetInfo_v2(self, free: Any, whole: Any) -> int:  # noqa: N802
        whole._obj.value = self.memory
        free._obj.value = self.memory - sum(one.nbytes for one in self.held.values())
        return 0

    def cuMemAlloc_v2(self, address: Any, size: Any) -> int:  # noqa: N802
        if sum(one.nbytes for one in self.held.values()) + size.value > self.memory:
            return OUT_OF_MEMORY
        held = np.full(size.value, 255, np.uint8)  # what is left over from others
        address._obj.value = held.ctypes.data
        self.held[held.ctypes.data] = held
        return 0

    def cuMemFree_v2(self, address: Any) -> int:  # noqa: N802
        del self.held[address.value]
        return 0

    def cuMemcpyHtoD_v2(self, address: Any, source: Any, size: Any) -> int:  # noqa: N802
        ctypes.memmove(address.value, source.value, size.value)
        return 0

    def cuMemcpy2DUnaligned_v2(self, given: Any) -> int:  # noqa: N802
        copy: _Copy = given._obj
        assert copy.source_kind == ON_DEVICE
        self.fetched += copy.width * copy.height
        for row in range(copy.height):
            source = copy.source_device + row * copy.source_pitch + copy.source_x
            ctypes.memmove(copy.target_host + row * copy.target_pitch, source, copy.width)
        return 0

    def cuModuleLoadDataEx(self, module: Any, code: bytes, *_: Any) -> int:  # noqa: N802
        self._engines.append(host_code(code.rstrip(b"\0").decode()))
        module._obj.value = len(self._engines)
        return 0

    def cuModuleGetFunction(self, function: Any, module: Any, name: bytes) -> int:  # noqa: N802
        function._obj.value = self._engines[module.value - 1].get_function_address(
            PARTS[name.decode()]
        )
        return 0

    def cuFuncGetAttribute(self, value: Any, _which: int, _function: Any) -> int:  # noqa: N802
        value._obj.value = 0
        return 0

    def cuLaunchKernel(  # noqa: N802
        self, function: Any, blocks: int, _y: int, _z: int, threads: int, *rest: Any
    ) -> int:
        if self.launches == self.lost_at:
            return LOST
        self.launches += 1
        given = rest[4]
        words = [ctypes.c_uint64.from_address(given[k]).value for k in range(8)]
        kind = ctypes.CFUNCTYPE(None, *[ctypes.c_uint64] * 9)
        for lane in range(min(blocks * threads, words[6])):
            kind(function.value)(*words, lane)
        return 0

    def cuStreamQuery(self, _stream: None) -> int:  # noqa: N802
        return 0

    def cuCtxSynchronize(self) -> int:  # noqa: N802
        return 0
