"""Compiling in another process: what comes out is the same, and it can be ended."""

from pathlib import Path

import numpy as np
import pytest

from jointplay.solver.kernels import cache, watched
from jointplay.solver.kernels.emit import machine_code, module
from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.target import own_target
from jointplay.solver.kernels.trace.equations import trace
from jointplay.solver.kernels.watched import CompilationTooLong, CompilationUnwanted
from jointplay.solver.mechanics.tree import spanning_tree
from tests.solver.random_mechanisms import chain

ENDLESS = "import time\n\nwhile True:\n    time.sleep(1.0)\n"


@pytest.fixture
def file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A file of Python that stands for a module which is compiled."""
    monkeypatch.setattr(watched, "_MODULE", "tests.solver.kernels.compile_python")
    monkeypatch.setenv("PYTHONPATH", str(Path(__file__).parents[3]))
    return tmp_path / "compiled.py"


def test_what_another_process_has_compiled_is_loaded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "cache_folder", lambda: tmp_path)
    monkeypatch.setattr(machine_code, "_loaded", set())
    monkeypatch.setattr(module, "compiled", None)  # nothing can be compiled here
    before = cache.SPENT.elsewhere
    lines = ("v0 = load 0", "v1 = add v0 v0", "store 0 v1")
    with watched.watched(lambda: None, 600.0):
        loaded = module.load([Source("twice_elsewhere", lines)])
    work = np.full((1, own_target().lanes), 1.5)
    loaded.twice_elsewhere(work)
    assert (work == 3.0).all()
    assert cache.SPENT.elsewhere > before
    assert {one.suffix for one in tmp_path.iterdir()} == {".o", ".lock"}


def test_code_that_is_unwanted_is_compiled_no_further(file: Path) -> None:
    answers = iter([None, None, "unwanted"])
    file.write_text(ENDLESS)
    with (
        pytest.raises(CompilationUnwanted) as ended,
        watched.watched(lambda: next(answers), 600.0),
    ):
        watched.compile_elsewhere(file)
    assert ended.value.answer == "unwanted"


def test_equations_that_are_unwanted_are_traced_no_further() -> None:
    scene = chain(12)
    with (
        pytest.raises(CompilationUnwanted) as ended,
        watched.watched(lambda: "unwanted", 600.0),
    ):
        trace(scene, spanning_tree(scene), "reduced")
    assert ended.value.answer == "unwanted"


def test_a_compilation_that_takes_too_long_is_ended(file: Path) -> None:
    file.write_text(ENDLESS)
    with (
        pytest.raises(CompilationTooLong, match="LONGEST_COMPILATION") as ended,
        watched.watched(lambda: None, 0.2),
    ):
        watched.compile_elsewhere(file)
    assert ended.value.code == "compile-time"


def test_a_compilation_that_takes_too_much_memory_is_ended(file: Path) -> None:
    """The bound counts what is asked for, so that nothing has to be filled."""
    file.write_text(f"import numpy as np\n\nnp.empty({2 * watched.MOST_MEMORY}, np.uint8)\n")
    with (
        pytest.raises(CompilationTooLong) as ended,
        watched.watched(lambda: None, 600.0),
    ):
        watched.compile_elsewhere(file)
    assert ended.value.code == "compile-memory"


def test_a_compilation_that_the_system_ends_is_told_from_one_that_fails(file: Path) -> None:
    file.write_text("import os, signal\n\nos.kill(os.getpid(), signal.SIGKILL)\n")
    with (
        pytest.raises(CompilationTooLong, match="or more than there is") as ended,
        watched.watched(lambda: None, 600.0),
    ):
        watched.compile_elsewhere(file)
    assert ended.value.code == "compile-memory"


def test_an_error_in_a_tape_is_raised_where_it_is_loaded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "cache_folder", lambda: tmp_path)
    with pytest.raises(KeyError, match="root"), watched.watched(lambda: None, 600.0):
        module.load([Source("of_no_operation", ("v0 = root 2.0", "return v0"))])
