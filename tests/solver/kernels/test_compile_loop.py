"""The integration loop is compiled apart from mechanisms: all of it."""

import importlib
import pkgutil
from pathlib import Path

import pytest

from jointplay.solver import kernels
from jointplay.solver.kernels import compile_loop
from jointplay.solver.kernels.jit import Deferred


def test_every_kernel_that_python_calls_is_compiled() -> None:
    found = set()
    for module in pkgutil.walk_packages(kernels.__path__, f"{kernels.__name__}."):
        members = vars(importlib.import_module(module.name)).values()
        found |= {one for one in members if isinstance(one, Deferred)}
    assert found == {one for part in compile_loop.PARTS.values() for one in part}


def test_what_is_compiled_already_is_left(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compile_loop, "cache_folder", lambda: tmp_path)
    compile_loop.compile_part(compile_loop.WINDOWS)
    (tmp_path / "runs-compiled").touch()
    monkeypatch.setattr(compile_loop, "subprocess", None)  # nothing can be started any more
    assert compile_loop.main([]) == 0
    (tmp_path / "windows-compiled").unlink()
    with pytest.raises(AttributeError):
        compile_loop.main([])
