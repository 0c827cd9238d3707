"""Code for devices: whole, and every operation rounded, so that no driver decides a bit."""

import re
import subprocess
from pathlib import Path

import pytest

from benchmarks.device.assembled import assembler
from jointplay.solver.kernels.device.compiled import code
from jointplay.solver.kernels.device.kernel_text import spare_rows
from jointplay.solver.kernels.device.lanes import Sizes
from jointplay.solver.kernels.device.loop_text import loop_text
from jointplay.solver.kernels.device.trimmed import slots_of_energies, without
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.emit.tangents import compile_tangents
from jointplay.solver.kernels.kernel_cache import ready_kernel
from tests.solver.readable_mechanics import preset

OF_FLOATS = re.compile(r"\b(?:add|sub|mul|div|sqrt|fma|mad|rcp)\.(?:\w+\.)*f(?:32|64)\b")
MOST_SPILLED = 1024
"""Bytes of registers that the press's loop may keep elsewhere, with 254 registers a thread."""
BY_BYTES = re.compile(r"\b(?:ld|st)\.b8\b")
"""Single bytes: a number takes eight where its record is not aligned, as that of contacts."""
EXTERNAL = {"sqrt", "numba_frexp", "NRT_MemInfo_call_dtor"}
"""Functions that Numba's text may call, beside LLVM's own."""


@pytest.fixture(scope="module")
def kernel() -> Kernel:
    return ready_kernel(preset("seven-bar-press"), "reduced", "tsitouras")


@pytest.fixture(scope="module")
def text(kernel: Kernel) -> str:
    return code(
        kernel.module.sources,
        kernel.slots,
        Sizes(0, kernel.layout.size, 8, 16, 0),
        on_host=False,
    )


def test_code_is_whole_and_calls_nothing_by_address(text: str) -> None:
    assert ".visible .entry advance(" in text
    assert ".extern" not in text
    assert ".callprototype" not in text
    assert "barrier.sync" in text


def test_every_operation_of_floats_is_rounded_as_written(text: str) -> None:
    found = set(OF_FLOATS.findall(text))
    assert {"fma.rn.f64", "mul.rn.f64", "add.rn.f64", "div.rn.f64", "sqrt.rn.f64"} <= found
    assert not {one for one in found if not one.endswith(".rn.f64")}


def test_numbers_of_a_step_are_in_the_threads_own_memory(text: str) -> None:
    begun = text.index("barrier.sync")  # an attempt begins there
    attempt = text[begun : text.index("\n}", begun)]
    assert attempt.count("ld.local") > 100
    assert re.search(r"\b(ld|st)\.(v\d\.)?b64", attempt) is None  # of any memory


def test_constants_are_read_from_constant_memory(text: str) -> None:
    assert ".const .align 8 .b8 constants[" in text
    assert "ld.const" in text


def test_numbers_of_runs_are_read_whole(text: str) -> None:
    assert "ld.b64" in text
    assert {*BY_BYTES.findall(text)} == {"st.b8"}  # of contacts


def test_tangents_are_whole_too(kernel: Kernel, text: str) -> None:
    tangents = compile_tangents(kernel)
    sources = [*kernel.module.sources, *tangents.module.sources]
    found = code(sources, tangents.slots, Sizes(0, tangents.layout.size, 8, 16, 8), on_host=False)
    assert ".extern" not in found
    assert ".callprototype" not in found
    assert BY_BYTES.findall(found) == BY_BYTES.findall(text)


def test_what_a_job_does_not_ask_for_makes_code_shorter(kernel: Kernel, text: str) -> None:
    sources = kernel.module.sources
    sizes = Sizes(0, kernel.layout.size, 8, 16, 0)
    lean = list(without(slots_of_energies(kernel), sources))
    shorter = code(lean, kernel.slots, sizes, on_host=False)
    assert stored(shorter) < stored(text)


def stored(text: str) -> int:
    return text.count("st.local")


def test_room_for_instants_is_that_of_the_rows_that_are_used(kernel: Kernel) -> None:
    rows = spare_rows(kernel.module.sources, kernel.layout.size)
    assert kernel.layout.block("impact_rate").stop <= rows < kernel.layout.size // 4


@pytest.mark.skipif(assembler() is None, reason="there is no ptxas")
def test_the_assembler_takes_it_and_spills_little(text: str, tmp_path: Path) -> None:
    source = tmp_path / "kernel.ptx"
    source.write_text(text)
    done = subprocess.run(
        [str(assembler()), "-v", "-arch=sm_90", "-o", str(tmp_path / "kernel.cubin"), str(source)],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    said = re.search(r"properties for advance\n.*?(\d+) bytes spill stores", done.stderr)
    assert said is not None, done.stderr
    assert int(said[1]) <= MOST_SPILLED


def test_numbas_text_calls_what_is_known() -> None:
    called = set(re.findall(r"^declare .*?@([\w.]+)\(", loop_text(), re.MULTILINE))
    assert {one for one in called if not one.startswith("llvm.")} <= EXTERNAL
