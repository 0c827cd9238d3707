"""Functions that kernels alone call are made machine code in their callers alone.

By itself Numba makes code of every function. But one without an entry for Python is never called
where it stands: those that call it link its text, of which the same code is made. Others in this
process may keep what Numba compiles for them on the disk: their functions are code there as ever.
"""

# mypy: disable-error-code="no-untyped-call, no-any-return, method-assign"

from typing import Any

from numba.core import codegen
from numba.core.targetconfig import TargetConfig

ENTRIES = ("_ZN7cpython", "cfunc.")
"""Beginnings of the names of functions that Python and C call."""


class Library(codegen.JITCodeLibrary):
    """A function with what it links, for this process."""

    @property
    def _is_inner(self) -> bool:
        """Whether kernels alone call it."""
        defined = [one.name for one in self._final_module.functions if not one.is_declaration]
        return not any(name.startswith(ENTRIES) for name in defined)

    def _finalize_final_module(self) -> None:
        has_code = self._object_caching_enabled and self._compiled_object is not None
        if has_code or not self._is_inner:
            super()._finalize_final_module()
            return
        self._finalize_dynamic_globals()
        self._verify_declare_only_symbols()
        self._finalized = True

    def serialize_using_object_code(self) -> tuple[Any, ...]:
        """Return what the cache keeps: of an inner function its text."""
        self._ensure_finalized()
        if self._compiled_object is None:
            text: tuple[Any, ...] = self.serialize_using_bitcode()
            return text
        code: tuple[Any, ...] = super().serialize_using_object_code()
        return code


def link_inner_functions() -> None:
    """Have Numba compile so, in this process."""
    codegen.JITCPUCodegen._library_class = Library
    codegen.JITCPUCodegen.set_env = _set_env
    TargetConfig.__eq__ = _same_settings


def _set_env(self: codegen.JITCPUCodegen, name: str, environment: Any) -> None:
    """Give a function what it raises with; an inner one has no code that could."""
    if self._engine.is_symbol_defined(name):
        _set_environment(self, name, environment)


def _same_settings(self: TargetConfig, other: object) -> bool:
    """Return whether two functions are compiled alike; asked 40 000 times, and nearly always so."""
    if isinstance(other, TargetConfig) and self._values == other._values:
        return True
    return _equal(self, other)


_set_environment = codegen.JITCPUCodegen.set_env
_equal = TargetConfig.__eq__
