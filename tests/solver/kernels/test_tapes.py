"""Functions of tapes: they call one another, are kept in a file, and take work arrays alone."""

import os
import re
from pathlib import Path

import numpy as np
import pytest
from llvmlite import binding
from numba import float64, int64, void

from jointplay.solver.kernels.emit.functions import WORK
from jointplay.solver.kernels.emit.tapes import Tapes
from jointplay.solver.kernels.target import Target, own_target

LANES = own_target().lanes

SQUARED = "v0 = load 0\nv1 = mul v0 v0\nstore 1 v1"
MOVED = "v0 = load 0+\nstore 2+ v0"
STEP = "call square\ncall move 1\nreturn call judge"


def step() -> Tapes:
    tapes = Tapes()
    tapes.add("square", SQUARED)
    tapes.add("move", MOVED, "row")
    tapes.add("judge", "v0 = load 3\nreturn v0")
    tapes.add("step", STEP)
    return tapes


def work_of(value: float) -> np.ndarray:
    work = np.zeros((4, LANES))
    work[0] = value
    return work


def test_a_tape_calls_others_and_has_the_value_of_the_last() -> None:
    functions = step().compiled()
    work = work_of(3.0)
    assert functions["step"](work) == 9.0
    assert work[3].tolist() == [9.0] * LANES
    signatures = {name: function.signature for name, function in functions.items()}
    assert signatures["square"] == void(WORK)
    assert signatures["move"] == void(WORK, int64)
    assert signatures["step"] == signatures["judge"] == float64(WORK)
    assert len({function.address for function in functions.values()}) == len(functions)


def test_tapes_of_one_name_in_two_modules_are_two() -> None:
    functions = []
    for tape in (SQUARED, SQUARED.replace("mul", "add")):
        tapes = Tapes()
        tapes.add("square", tape)
        functions.append(tapes.compiled()["square"])
    for function, expected in zip(functions, (9.0, 6.0), strict=True):
        work = work_of(3.0)
        function(work)
        assert work[1].tolist() == [expected] * LANES


def test_code_is_compiled_once_and_the_same_each_time(tmp_path: Path) -> None:
    source, other = tmp_path / "kernel.py", tmp_path / "other.py"
    step().compiled(str(source))
    (kept,) = tmp_path.iterdir()
    assert kept.suffix == ".o"
    changed = kept.stat().st_mtime_ns
    work = work_of(2.0)
    assert step().compiled(str(source))["step"](work) == 4.0
    assert [(one, one.stat().st_mtime_ns) for one in tmp_path.iterdir()] == [(kept, changed)]
    step().compiled(str(other))
    (again,) = tmp_path.glob("other.*")
    assert again.read_bytes() == kept.read_bytes()


@pytest.mark.parametrize("work", [work_of(1.0).astype(np.float32), work_of(1.0)[:, ::2]])
def test_what_is_no_work_array_is_not_taken(work: np.ndarray) -> None:
    with pytest.raises(TypeError, match="contiguous arrays of floats"):
        step().compiled()["square"](work)


@pytest.mark.skipif(os.uname().machine != "x86_64", reason="registers and stack of x86-64")
def test_vectors_on_the_stack_lie_in_one_line_of_the_cache() -> None:
    """Forty vectors that are needed in the end, of which 32 registers cannot hold all."""
    numbers = range(40)
    lines = [f"v{i} = load {i}" for i in numbers]
    lines += [f"w{i} = mul v{i} v{(7 * i + 1) % 40}\nstore {40 + i} w{i}" for i in numbers]
    tapes, target = Tapes(), Target(8, "x86-64-v4", "")
    tapes.add("crowded", "\n".join(lines))
    text = tapes.sources[0].of_numbers(lambda name: f"@{name}", target.lanes)
    code = target.machine().emit_assembly(binding.parse_assembly(text))
    moved = re.findall(r"(vmov\w+) .*%rsp\)", code.replace("\t", " "))
    assert moved  # by instructions that ask for such a place
    assert set(moved) <= {"vmovaps", "vmovapd"}
