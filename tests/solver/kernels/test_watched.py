"""Compiling in another process: what comes out is the same, and it can be ended."""

import os
from pathlib import Path

import pytest

from jointplay.solver.kernels import cache, watched
from jointplay.solver.kernels.trace.equations import trace
from jointplay.solver.kernels.watched import CompilationTooLong, CompilationUnwanted
from jointplay.solver.mechanics.tree import spanning_tree
from tests.solver.random_mechanisms import chain

SOURCE = """
from numba import float64, njit


@njit(float64(float64), cache=True)
def twice(x):
    return 2.0 * x  # {number}
"""
ENDLESS = "import time\n\nwhile True:\n    time.sleep(1.0)  # {number}\n"


@pytest.fixture
def file(tmp_path: Path) -> str:
    """A text that makes a source of this test's own: sources are known by their text."""
    return str(tmp_path)


def marked(source: str) -> bool:
    path = next(p for p in cache.cache_folder().glob("*.py") if p.read_text() == source)
    return cache.is_compiled(path)


def test_what_another_process_has_compiled_is_loaded(file: str) -> None:
    source = SOURCE.format(number=file)
    before = cache.SPENT.elsewhere
    with watched.watched(lambda: None, 600.0):
        module = cache.load(source)
    assert module.twice(1.5) == 3.0
    assert cache.SPENT.elsewhere > before
    (hits,) = module.twice.stats.cache_hits.values()
    assert hits == 1
    assert marked(source)


def test_code_that_is_unwanted_is_compiled_no_further(file: str) -> None:
    answers = iter([None, None, "unwanted"])
    source = ENDLESS.format(number=file)
    with (
        pytest.raises(CompilationUnwanted) as ended,
        watched.watched(lambda: next(answers), 600.0),
    ):
        cache.load(source)
    assert ended.value.answer == "unwanted"
    assert not marked(source)


def test_equations_that_are_unwanted_are_traced_no_further() -> None:
    scene = chain(12)
    with (
        pytest.raises(CompilationUnwanted) as ended,
        watched.watched(lambda: "unwanted", 600.0),
    ):
        trace(scene, spanning_tree(scene), "reduced")
    assert ended.value.answer == "unwanted"


def test_a_compilation_that_takes_too_long_is_ended(file: str) -> None:
    with (
        pytest.raises(CompilationTooLong, match="LONGEST_COMPILATION") as ended,
        watched.watched(lambda: None, 0.2),
    ):
        cache.load(ENDLESS.format(number=file))
    assert ended.value.code == "compile-time"


def test_a_compilation_that_takes_too_much_memory_is_ended(file: str) -> None:
    """The bound counts what is asked for, so that nothing has to be filled."""
    hungry = (
        f"import numpy as np\n\nheld = np.empty({2 * watched.MOST_MEMORY}, np.uint8)  # {file}\n"
    )
    with (
        pytest.raises(CompilationTooLong) as ended,
        watched.watched(lambda: None, 600.0),
    ):
        cache.load(hungry)
    assert ended.value.code == "compile-memory"


def test_a_compilation_that_the_system_ends_is_not_repeated_here(file: str) -> None:
    elsewhere = f"if os.getpid() != {os.getpid()}:\n    os.kill(os.getpid(), signal.SIGKILL)"
    killed = f"import os, signal\n\n{elsewhere}  # {file}\n"
    with (
        pytest.raises(CompilationTooLong, match="or more than there is") as ended,
        watched.watched(lambda: None, 600.0),
    ):
        cache.load(killed)
    assert ended.value.code == "compile-memory"


def test_an_error_in_the_source_is_raised_where_it_is_loaded(file: str) -> None:
    with pytest.raises(ZeroDivisionError), watched.watched(lambda: None, 600.0):
        cache.load(f"1 / 0  # {file}\n")
