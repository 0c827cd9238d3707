"""The integration loop is compiled apart from mechanisms: all of it."""

import importlib
import pkgutil
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from jointplay.solver import kernels
from jointplay.solver.kernels import compile_loop
from jointplay.solver.kernels.jit import Deferred
from jointplay.solver.kernels.target import own_target


def test_every_kernel_that_python_calls_is_compiled() -> None:
    found = set()
    for module in pkgutil.walk_packages(kernels.__path__, f"{kernels.__name__}."):
        members = vars(importlib.import_module(module.name)).values()
        found |= {one for one in members if isinstance(one, Deferred)}
    assert found == {one for part in compile_loop.PARTS.values() for one in part}


def test_what_is_compiled_already_is_left(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compile_loop, "cache_folder", lambda: tmp_path)
    compile_loop.compile_part(compile_loop.WINDOWS)
    compile_loop.marker(compile_loop.RUNS).touch()
    monkeypatch.setattr(compile_loop, "subprocess", None)  # nothing can be started any more
    assert compile_loop.main([]) == 0
    compile_loop.marker(compile_loop.WINDOWS).unlink()
    with pytest.raises(AttributeError):
        compile_loop.main([])


@pytest.mark.parametrize("other", [{"lanes": 2}, {"processor": "another"}])
def test_what_is_compiled_for_another_target_is_compiled_again(
    other: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(compile_loop, "cache_folder", lambda: tmp_path)
    compile_loop.compile_part(compile_loop.RUNS)
    assert compile_loop.begin(compile_loop.RUNS) is None
    target = replace(own_target(), **other)
    monkeypatch.setattr(compile_loop, "own_target", lambda: target)
    assert not compile_loop.marker(compile_loop.RUNS).exists()
