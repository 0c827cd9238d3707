"""Entry points of compiled loops: what Python calls, without the compiler that compiled them.

Their code is kept in the cache. A process that computes loads it from there. It takes the address
of its arguments, which are words of eight bytes, as Numba lays them out: an array is seven words
and more, a named tuple is its members.
"""

import struct
from collections.abc import Callable
from ctypes import PYFUNCTYPE, c_int32, c_void_p
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

POINTER, INTEGRAL, FLOATING = "P", "q", "d"
"""Kinds of words, as `struct` calls them: an address, a whole number, any number."""


@dataclass(frozen=True)
class Number:
    """A number among an entry point's arguments."""

    words: str
    """Kind of the word that it is passed as."""

    def passed(self, number: Any) -> tuple[Any, ...]:
        """Return what is passed of it."""
        return (number,)


INTEGER, REAL = Number(INTEGRAL), Number(FLOATING)


@dataclass(frozen=True)
class Array:
    """A contiguous array among them, of elements of one type and so many dimensions."""

    dtype: np.dtype[Any]
    dimensions: int

    @classmethod
    def of(cls, dtype: DTypeLike, dimensions: int) -> "Array":
        """Return the type of arrays of such elements."""
        return cls(np.dtype(dtype), dimensions)

    @property
    def words(self) -> str:
        """Kinds of its words: two owners, sizes, the address of its elements, shape, strides."""
        return 2 * POINTER + 2 * INTEGRAL + POINTER + 2 * self.dimensions * INTEGRAL

    def passed(self, array: NDArray[Any]) -> tuple[Any, ...]:
        """Return what is passed of it. Raises TypeError if it is another kind of array."""
        alike = array.dtype == self.dtype and array.ndim == self.dimensions
        if not alike or not array.flags.carray:
            raise TypeError(
                f"a contiguous array, which can be written, of {self.dimensions} dimensions of"
                f" {self.dtype} is wanted, not one of {array.ndim} of {array.dtype}"
            )
        address = array.ctypes.data
        return (0, 0, array.size, array.itemsize, address, *array.shape, *array.strides)


@dataclass(frozen=True)
class Structure:
    """A named tuple among them: its class, and what its members are."""

    kind: type[tuple[Any, ...]]
    members: tuple["Argument", ...]

    @property
    def words(self) -> str:
        """Kinds of the words that it is passed as."""
        return "".join(one.words for one in self.members)

    def passed(self, given: tuple[Any, ...]) -> tuple[Any, ...]:
        """Return what is passed of it."""
        return _all_passed(self.members, given)


Argument = Number | Array | Structure


def _all_passed(arguments: tuple[Argument, ...], given: tuple[Any, ...]) -> tuple[Any, ...]:
    words: list[Any] = []
    for argument, one in zip(arguments, given, strict=True):
        words += argument.passed(one)
    return tuple(words)


@dataclass(frozen=True, eq=False)
class EntryPoint:
    """A function of the loop that Python calls; its code is loaded at the first call."""

    name: str
    address: Callable[[str], int]
    """Returns where the code of a name is loaded; that may take until it is compiled."""
    arguments: tuple[Argument, ...]
    value: Number | None = None
    """Type of what it returns, if anything."""

    @property
    def symbol(self) -> str:
        """Name of its code."""
        return f"jointplay.{self.name}"

    @cached_property
    def words(self) -> str:
        """Kinds of the words that it takes: its value and what failed, which it writes, first."""
        value = INTEGRAL if self.value is None else self.value.words
        return value + POINTER + "".join(one.words for one in self.arguments)

    def __call__(self, *arguments: Any) -> Any:
        """Run it with these arguments; as `PreparedCall` does."""
        return self.prepare(*arguments)()

    def prepare(self, *arguments: Any) -> "PreparedCall":
        """Return what runs it with these arguments, whose arrays must not be replaced meanwhile.

        To lay out a dozen arrays takes as long as some twenty steps do.

        Raises
        ------
        TypeError
            An argument is not of its type.
        ValueError
            There are more or fewer.
        """
        passed = _all_passed(self.arguments, arguments)
        try:
            return PreparedCall(self, struct.pack(self.words, 0, 0, *passed), arguments)
        except struct.error as error:
            raise TypeError(f"'{self.name}' takes other numbers: {error}") from error

    @cached_property
    def code(self) -> Callable[[int], int]:
        """The code, which takes the address of words; its value is 0 if all went well."""
        kind = PYFUNCTYPE(c_int32, c_void_p)
        found: Callable[[int], int] = kind(self.address(self.symbol))
        return found


class PreparedCall:
    """A call of an entry point that can be repeated."""

    def __init__(self, entry_point: EntryPoint, words: bytes, arguments: tuple[Any, ...]) -> None:
        self._name, self._code = entry_point.name, entry_point.code
        self._words = np.frombuffer(bytearray(words), np.int64)
        self._address = self._words.ctypes.data
        value = entry_point.value
        self._value = None if value is None else self._words[:1].view(value.words)
        self._arguments = arguments  # kept alive

    def __call__(self, *last: int) -> Any:
        """Run it; `last` : other whole numbers for its last arguments.

        Raises
        ------
        RuntimeError
            It failed, as for want of memory.
        """
        if last:
            self._words[-len(last) :] = last
        if status := self._code(self._address):
            raise RuntimeError(f"the loop's '{self._name}' failed, with status {status}")
        return None if self._value is None else self._value[0].item()
