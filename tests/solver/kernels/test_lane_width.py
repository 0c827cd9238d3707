"""A run has the same bits at every width and for every processor, and goes on at another."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from jointplay.records.failure import InvalidInput
from jointplay.solver.kernels.target import own_target, target_of

PROGRAM = """
import hashlib, json, sys
from pathlib import Path
import numpy as np
from jointplay.solver.kernels.emit.kernel import compile_kernel
from jointplay.solver.integrators import TSITOURAS5
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.kernels.target import own_target
from jointplay.solver.kinds import admit
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.runs import budget
from jointplay.solver.runs.simulate import Simulation
from tests.solver.readable_mechanics import preset

budget.FIRST = budget.LARGEST = 200  # attempts a slice, so that there are many
saved = Path(sys.argv[1])
whole, rest = hashlib.sha256(), hashlib.sha256()

random = np.random.default_rng(20)
problems = [
    LaneProblem(
        preset("bouncing-journal", velocity_x=random.uniform(0, 1), spin=random.uniform(-9, 9)),
        random.uniform(0.1, 0.4), 10.0 ** random.uniform(-8, -5), 0.01, 11, 0, 0.0,
    )
    for _ in range(8)
]
scene = problems[0].scene
kernel = compile_kernel(scene, spanning_tree(scene), "reduced", TSITOURAS5)
bundle = Bundle(kernel, problems)
while bundle.advance(100):
    pass
for name in ("y", "steps", "total", "highest", "highest_time", "lowest", "lowest_time"):
    whole.update(bundle.block(name).tobytes())
whole.update(bundle.runs["onsets"].tobytes())

def take(digest, simulation):
    pieces = [(piece.samples, piece.sections, piece.impacts) for piece in simulation.slices()]
    assert len(pieces) > 3
    for kind in zip(*pieces):
        digest.update(b"".join(part.tobytes() for part in kind))
    found = simulation.certificate()
    digest.update(json.dumps(found.facts, sort_keys=True).encode())
    for name in ("time", "error", "until", "extremes", "edges", "share", "spread"):
        digest.update(getattr(found, name).tobytes())

admission = admit({
    "kind": "simulate", "scene": {"preset": "bouncing-journal", "parameters": {"spin": 3.0}},
    "duration": 0.3, "output_step": 1e-3,
})
simulation = Simulation(admission)
pieces = simulation.slices()
for _ in range(3):
    next(pieces)
if not saved.exists():
    saved.write_bytes(simulation.checkpoint())
take(whole, Simulation(admission))
take(rest, Simulation(admission, saved.read_bytes()))
print(json.dumps({
    "lanes": own_target().lanes, "onsets": int(bundle.runs["onsets"].sum()),
    "whole": whole.hexdigest(), "rest": rest.hexdigest(),
}))
"""


def run(checkpoint: Path, lanes: str, **settings: str) -> dict[str, Any]:
    """Run the program in a process of that many lanes."""
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(checkpoint)],
        cwd=Path(__file__).parents[3],
        env=os.environ | {"JOINTPLAY_LANES": lanes} | settings,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    found: dict[str, Any] = json.loads(done.stdout)
    return found


@pytest.fixture(scope="module")
def eight(tmp_path_factory: pytest.TempPathFactory) -> tuple[dict[str, Any], Path]:
    """Return what eight lanes give, and the checkpoint that they left."""
    checkpoint = tmp_path_factory.mktemp("eight") / "by-eight"
    return run(checkpoint, "8"), checkpoint


@pytest.mark.parametrize(
    "lanes",
    [pytest.param("1", marks=pytest.mark.long), "4"],
)
def test_fewer_lanes_give_the_bits_of_eight_and_take_their_checkpoints(
    lanes: str, eight: tuple[dict[str, Any], Path], tmp_path: Path
) -> None:
    expected, checkpoint = eight
    found = run(checkpoint, lanes)
    assert (expected["lanes"], found["lanes"]) == (8, int(lanes))
    assert expected["onsets"] > 20
    assert found["whole"] == expected["whole"]
    assert found["rest"] == expected["rest"]
    again = run(tmp_path / "by-fewer", lanes)
    assert run(tmp_path / "by-fewer", "8")["rest"] == again["rest"]


@pytest.mark.long  # compiles the loop for another processor
@pytest.mark.skipif(os.uname().machine != "x86_64", reason="Arm has one kind of arithmetic")
def test_an_older_processor_gives_the_bits_of_this_one(eight: tuple[dict[str, Any], Path]) -> None:
    expected, checkpoint = eight
    older = {"NUMBA_CPU_NAME": "x86-64-v3", "NUMBA_CPU_FEATURES": ""}
    found = run(checkpoint, "4", **older)
    assert found["whole"] == expected["whole"]
    assert found["rest"] == expected["rest"]


@pytest.mark.parametrize("lanes", ["2", "16", "eight"])
def test_another_number_of_lanes_is_refused_with_a_sentence(
    lanes: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("JOINTPLAY_LANES", lanes)
    with pytest.raises(InvalidInput) as refused:
        own_target.__wrapped__()  # this process has chosen its own before
    (problem,) = refused.value.problems
    assert "JOINTPLAY_LANES" in problem.pointer
    assert (
        f"It is '{lanes}'; it must be 1 (no vectors), 4 (vectors of 256 bits) or 8 (512 bits)"
        in problem.detail
    )


PROCESSORS = {"x86_64": {"haswell": 4, "x86-64-v4": 8}, "aarch64": {"generic": 4}}


def test_the_width_is_that_of_the_processor_that_is_compiled_for() -> None:
    for processor, lanes in PROCESSORS[os.uname().machine].items():
        chosen = {"NUMBA_CPU_NAME": processor, "NUMBA_CPU_FEATURES": "", "JOINTPLAY_LANES": ""}
        done = subprocess.run(
            [
                sys.executable,
                "-c",
                "from jointplay.solver.kernels.target import own_target; print(own_target().lanes)",
            ],
            env=os.environ | chosen,
            capture_output=True,
            text=True,
            check=True,
        )
        assert int(done.stdout) == lanes, processor


@pytest.mark.skipif(os.uname().machine != "x86_64", reason="any 64-bit Arm has fused products")
def test_a_processor_without_fused_products_is_refused_by_name() -> None:
    with pytest.raises(InvalidInput, match=r"processor 'x86-64-v2' has no fused multiplication"):
        target_of("x86-64-v2", "")
