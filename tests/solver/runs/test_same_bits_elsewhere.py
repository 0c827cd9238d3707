"""Jobs have the same bits where libraries take the routines of another processor."""

import os
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from benchmarks import digests
from jointplay.solver.scene import presets

JOINTPLAY = str(Path(sys.executable).with_name("jointplay"))
FEATURES: Any = np.show_config(mode="dicts")
ELSEWHERE = {
    "OPENBLAS_CORETYPE": "Prescott" if os.uname().machine == "x86_64" else "ARMV8",
    "NPY_DISABLE_CPU_FEATURES": " ".join(FEATURES["SIMD Extensions"].get("found", [])),
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX512F,-AVX2,-AVX2_Usable,-FMA,-FMA_Usable,-FMA4",
}
"""Routines of a processor of 2004 in OpenBLAS, NumPy and the C library."""


def without_play(preset: str, joint: str) -> dict[str, Any]:
    """Return a preset's document with a joint closed, and no parameter."""
    scene = presets.document(preset)
    scene["joints"][joint]["clearance"] = None
    return {**scene, "parameters": {}}


INDICATORS = ["lyapunov", "zero_one", "recurrence", "rotation", "spectrum"]
SAMPLE: dict[str, dict[str, Any]] = {
    "with play": {
        "kind": "simulate",
        "scene": {"preset": "seven-bar-press"},
        "duration": 0.005,
        "output_step": 1e-4,
    },
    "all indicators": {
        "kind": "poincare",
        "scene": {"preset": "driven-pendulum"},
        "settle": 20,
        "record": 64,
        "indicators": INDICATORS,
    },
    "ideal": {
        "kind": "simulate",
        "scene": without_play("slider-crank", "P"),
        "duration": 0.1,
        "output_step": 1e-3,
    },
}


@pytest.fixture
def elsewhere(monkeypatch: pytest.MonkeyPatch) -> pytest.MonkeyPatch:
    """Return what may set processes to come to the routines of another processor."""
    for name in ELSEWHERE:
        monkeypatch.delenv(name, raising=False)
    return monkeypatch


def _expect_the_same(document: dict[str, Any], folder: Path, elsewhere: pytest.MonkeyPatch) -> None:
    own = digests.run(JOINTPLAY, document, folder / "own")
    assert own
    assert all(own.values())
    for name, value in ELSEWHERE.items():
        elsewhere.setenv(name, value)
    assert digests.run(JOINTPLAY, document, folder / "other") == own


@pytest.mark.parametrize("name", SAMPLE)
def test_a_job_has_the_bits_of_any_processor(
    name: str, tmp_path: Path, elsewhere: pytest.MonkeyPatch
) -> None:
    _expect_the_same(SAMPLE[name], tmp_path, elsewhere)


@pytest.mark.long
@pytest.mark.parametrize("name", [name for name, _ in digests.documents()])
def test_every_digest_is_that_of_any_processor(
    name: str, tmp_path: Path, elsewhere: pytest.MonkeyPatch
) -> None:
    _expect_the_same(dict(digests.documents())[name], tmp_path, elsewhere)
