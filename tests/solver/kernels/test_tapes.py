"""Functions of tapes: they call one another, are kept in a file, and take work arrays alone."""

import os
import platform
import re
from pathlib import Path

import numpy as np
import pytest
from llvmlite import binding

from jointplay.solver.kernels.emit import machine_code, module
from jointplay.solver.kernels.emit.functions import (
    ARRAY,
    INDEX,
    MARKING,
    OVER_LANES,
    Signature,
)
from jointplay.solver.kernels.emit.module import load
from jointplay.solver.kernels.emit.tapes import Source, module_text
from jointplay.solver.kernels.target import Target, own_target

LANES = own_target().lanes

SQUARED = "v0 = load 0\nv1 = mul v0 v0\nstore 1 v1"
MOVED = "v0 = load 0+\nstore 2+ v0"
STEP = "call square\ncall move 1\nreturn call judge"


SOURCES = [
    Source("square", tuple(SQUARED.splitlines())),
    Source("move", tuple(MOVED.splitlines()), "row"),
    Source("judge", ("v0 = load 3", "return v0")),
    Source("step", tuple(STEP.splitlines())),
]


def work_of(value: float) -> np.ndarray:
    work = np.zeros((4, LANES))
    work[0] = value
    return work


def test_a_tape_calls_others_and_has_the_value_of_the_last() -> None:
    step = load(SOURCES)
    work = work_of(3.0)
    assert step.step(work) == (1 << LANES) - 1
    assert work[3].tolist() == [9.0] * LANES
    assert step.square.signature == OVER_LANES
    assert step.move.signature == Signature("void", (ARRAY, INDEX))
    assert step.step.signature == step.judge.signature == MARKING
    assert len({getattr(step, one.name).address for one in SOURCES}) == len(SOURCES)


def test_tapes_of_one_name_in_two_modules_are_two() -> None:
    tapes = (SQUARED, SQUARED.replace("mul", "add"))
    modules = [load([Source("square", tuple(tape.splitlines()))]) for tape in tapes]
    for squaring, expected in zip(modules, (9.0, 6.0), strict=True):
        work = work_of(3.0)
        squaring.square(work)
        assert work[1].tolist() == [expected] * LANES


def forget(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let a process know of no code that it has loaded."""
    monkeypatch.setattr(machine_code, "_loaded", set())


def test_code_is_compiled_once_and_the_same_each_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "cache_folder", lambda: tmp_path)
    forget(monkeypatch)
    sources = [*SOURCES, Source("of_this_test")]
    load(sources)
    (kept,) = tmp_path.glob("*.o")
    code = kept.read_bytes()
    kept.unlink()
    load(sources)
    assert not kept.exists()  # it is loaded already
    forget(monkeypatch)
    load(sources)
    assert kept.read_bytes() == code
    forget(monkeypatch)
    monkeypatch.setattr(module, "compiled", None)  # nothing can be compiled any more
    assert load(sources).step(work_of(2.0)) == (1 << LANES) - 1


@pytest.mark.parametrize("work", [work_of(1.0).astype(np.float32), work_of(1.0)[:, ::2]])
def test_what_is_no_work_array_is_not_taken(work: np.ndarray) -> None:
    with pytest.raises(TypeError, match="contiguous arrays of floats"):
        load(SOURCES).square(work)


@pytest.mark.skipif(os.uname().machine != "x86_64", reason="registers and stack of x86-64")
def test_vectors_on_the_stack_lie_in_one_line_of_the_cache() -> None:
    """Forty vectors that are needed in the end, of which 32 registers cannot hold all."""
    numbers = range(40)
    lines = [f"v{i} = load {i}" for i in numbers]
    for i in numbers:
        lines += [f"w{i} = mul v{i} v{(7 * i + 1) % 40}", f"store {40 + i} w{i}"]
    target = Target(8, "x86-64-v4", "")
    text = Source("crowded", tuple(lines)).function_text(lambda name: f"@{name}", target.lanes)
    code = target.machine().emit_assembly(binding.parse_assembly(text))
    moved = re.findall(r"(vmov\w+) .*%rsp\)", code.replace("\t", " "))
    assert moved  # by instructions that ask for such a place
    assert set(moved) <= {"vmovaps", "vmovapd"}


KEPT = ("v0 = load 0", "v1 = load 1", "v2 = load 2", "v3 = select v0 v1 v2", "store 2 v3")
SCALED = ("v0 = load 0", "v1 = mul v0 0.3", "store 1 v1")


@pytest.fixture(params=[(4, "x86-64-v3"), (8, "x86-64-v4")])
def code(request: pytest.FixtureRequest) -> str:
    """Instructions of both tapes."""
    if platform.machine() not in ("x86_64", "AMD64"):
        pytest.skip("instructions of another processor have other names")
    lanes, processor = request.param
    text = module_text([Source("keep", KEPT), Source("scale", SCALED)], "code", lanes)
    machine = Target(lanes, processor, "").machine()
    return str(machine.emit_assembly(binding.parse_assembly(text)))


def test_numbers_that_some_lanes_keep_are_stored_whole(code: str) -> None:
    assert "vcmpltpd" in code
    assert not re.search(r"vmaskmov|vmov[au]pd.*\) \{%k\d\}$", code, re.MULTILINE), code


def test_numbers_written_out_are_read_beside_their_instructions(code: str) -> None:
    assert re.search(r"LCPI\S*\(%rip\)", code)
    assert "movabs" not in code
