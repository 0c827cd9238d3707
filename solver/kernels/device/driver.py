"""A device's driver, `libcuda`: code, memory and launches. Nothing is needed to build or install.

Only what the driver itself says of the device is known here; see
https://docs.nvidia.com/cuda/cuda-driver-api.
"""

import ctypes
from collections.abc import Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

LIBRARY = "libcuda.so.1"
PROCESSORS, RATIO = 16, 87
"""Attributes of a device: its multiprocessors, and how many times as many operations in single as
in double precision it makes."""
REGISTERS, LOCAL = 4, 3
"""Attributes of a function: registers, and bytes of own memory of a thread."""
ON_HOST, ON_DEVICE = 1, 2
LOG = 8192
"""Bytes of what the driver says about code that it does not take."""
ERROR_LOG, ERROR_LOG_SIZE = 5, 6


class DeviceError(OSError):
    """The device or its driver did not do what was asked for."""


class _Copy(ctypes.Structure):
    """`CUDA_MEMCPY2D`: rows of bytes, from one memory to another."""

    _fields_ = [
        (f"{side}_{name}", kind)
        for side in ("source", "target")
        for name, kind in (
            ("x", ctypes.c_size_t),
            ("y", ctypes.c_size_t),
            ("kind", ctypes.c_uint),
            ("host", ctypes.c_void_p),
            ("device", ctypes.c_uint64),
            ("array", ctypes.c_void_p),
            ("pitch", ctypes.c_size_t),
        )
    ] + [("width", ctypes.c_size_t), ("height", ctypes.c_size_t)]


class Device:
    """A device, and the context of this process on it."""

    def __init__(self, number: int = 0, *, name: str = LIBRARY, library: Any = None) -> None:
        """Open it, by the library of this name, or by what stands in for one: a `HostDriver`.

        Raises
        ------
        DeviceError
            There is no driver, or no such device.
        """
        self.on_host = library is not None
        try:
            self._library = library or ctypes.CDLL(name)
        except OSError as error:
            raise DeviceError(f"there is no driver of a device: {error}") from error
        self._device, context = ctypes.c_int(), ctypes.c_void_p()
        self.call("cuInit", 0)
        self.call("cuDeviceGet", ctypes.byref(self._device), number)
        self.call("cuDevicePrimaryCtxRetain", ctypes.byref(context), self._device)
        self.call("cuCtxSetCurrent", context)

    def call(self, name: str, *arguments: Any) -> None:
        """Call a function of the driver.

        Raises
        ------
        DeviceError
            With the function's and the driver's own name of what went wrong.
        """
        code = getattr(self._library, name)(*arguments)
        if code:
            said = ctypes.c_char_p()
            self._library.cuGetErrorName(code, ctypes.byref(said))
            raise DeviceError(f"{name}: {(said.value or b'unknown').decode()} ({code})")

    @cached_property
    def name(self) -> str:
        """The maker's name of the device."""
        said = ctypes.create_string_buffer(256)
        self.call("cuDeviceGetName", said, len(said), self._device)
        return said.value.decode()

    @property
    def processors(self) -> int:
        """Number of its multiprocessors."""
        return self._attribute(PROCESSORS)

    @property
    def ratio(self) -> int:
        """Operations in single precision that it makes in the time of one in double."""
        return self._attribute(RATIO)

    def _attribute(self, which: int) -> int:
        value = ctypes.c_int()
        self.call("cuDeviceGetAttribute", ctypes.byref(value), which, self._device)
        return value.value

    def finish(self) -> None:
        """Wait until all launches are done."""
        self.call("cuCtxSynchronize")


class Code:
    """Kernels, loaded, by their names."""

    def __init__(self, device: Device, text: str) -> None:
        """Have the driver make code of their text in PTX; seconds.

        Raises
        ------
        DeviceError
            With what the driver says about the text.
        """
        self._device, self._module = device, ctypes.c_void_p()
        log = ctypes.create_string_buffer(LOG)
        options = (ctypes.c_int * 2)(ERROR_LOG, ERROR_LOG_SIZE)
        values = (ctypes.c_void_p * 2)(ctypes.addressof(log), LOG)
        code = text.encode() + b"\0"
        try:
            device.call("cuModuleLoadDataEx", ctypes.byref(self._module), code, 2, options, values)
        except DeviceError as error:
            raise DeviceError(f"{error}: {log.value.decode(errors='replace')}") from error

    def _kernel(self, name: str) -> ctypes.c_void_p:
        found = ctypes.c_void_p()
        self._device.call("cuModuleGetFunction", ctypes.byref(found), self._module, name.encode())
        return found

    def attribute(self, name: str, which: int) -> int:
        """Return `REGISTERS` or `LOCAL` of a kernel."""
        value = ctypes.c_int()
        self._device.call("cuFuncGetAttribute", ctypes.byref(value), which, self._kernel(name))
        return value.value

    def launch(self, name: str, threads: int, block: int, arguments: Sequence[int]) -> None:
        """Begin at least so many threads in blocks of so many; arguments are words."""
        words = [ctypes.c_uint64(argument) for argument in arguments]
        given = (ctypes.c_void_p * len(words))(*map(ctypes.addressof, words))
        blocks = -(-threads // block)
        grid = (blocks, 1, 1, block, 1, 1)
        self._device.call("cuLaunchKernel", self._kernel(name), *grid, 0, None, given, None)


class Memory:
    """An array on a device."""

    def __init__(self, device: Device, shape: tuple[int, ...], kind: Any) -> None:
        """Take memory for it, whose content is left over from others until it is written."""
        self._device, self._shape, self._kind = device, shape, np.dtype(kind)
        self.address = 0
        address = ctypes.c_uint64()
        size = max(int(np.prod(shape)) * self._kind.itemsize, 1)
        device.call("cuMemAlloc_v2", ctypes.byref(address), ctypes.c_size_t(size))
        self.address = address.value

    def write(self, array: NDArray[Any]) -> None:
        """Set its first numbers, in their order: all of it, or as many as there are."""
        array = np.ascontiguousarray(array, self._kind)
        if array.size > np.prod(self._shape):
            raise ValueError(f"an array {self._shape} has no room for one {array.shape}")
        source = ctypes.c_void_p(array.ctypes.data)
        size = ctypes.c_size_t(array.nbytes)
        self._device.call("cuMemcpyHtoD_v2", ctypes.c_uint64(self.address), source, size)

    def read(self, count: int | None = None) -> NDArray[Any]:
        """Return a copy of the first `count` columns of its last axis, by default of all."""
        width = self._shape[-1]
        count = width if count is None else count
        found = np.empty((*self._shape[:-1], count), self._kind)
        if found.size:
            pitch = width * self._kind.itemsize
            self._copy(found, self.address, pitch, found.size // count)
        return found

    def part(self, shape: tuple[int, ...], first: int = 0) -> NDArray[Any]:
        """Return a copy of some of its numbers, in their order, from this one on."""
        found = np.empty(shape, self._kind)
        if found.size:
            address = self.address + first * self._kind.itemsize
            self._copy(found, address, found.nbytes, 1)
        return found

    def _copy(self, found: NDArray[Any], address: int, pitch: int, height: int) -> None:
        """Fill an array with so many rows of bytes, each `pitch` behind the one before."""
        width = found.nbytes // height
        copy = _Copy(
            source_kind=ON_DEVICE,
            source_device=address,
            source_pitch=pitch,
            target_kind=ON_HOST,
            target_host=found.ctypes.data,
            target_pitch=width,
            width=width,
            height=height,
        )
        self._device.call("cuMemcpy2DUnaligned_v2", ctypes.byref(copy))

    def release(self) -> None:
        """Give the memory back."""
        if self.address:
            self._device.call("cuMemFree_v2", ctypes.c_uint64(self.address))
            self.address = 0
