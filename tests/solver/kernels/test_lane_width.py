"""A run has the same bits on four lanes as on eight, and goes on at one width from the other."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

PROGRAM = """
import hashlib, json, sys
from pathlib import Path
import numpy as np
from jointplay.solver.kernels.emit.kernel import compile_kernel
from jointplay.solver.integrators import TSITOURAS5
from jointplay.solver.kernels.lanes import LANES
from jointplay.solver.kernels.loop.bundle import Bundle
from jointplay.solver.kernels.loop.problem import LaneProblem
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
    assert len(pieces) > 5
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
    "lanes": LANES, "onsets": int(bundle.runs["onsets"].sum()),
    "whole": whole.hexdigest(), "rest": rest.hexdigest(),
}))
"""


def run(lanes: str, checkpoint: Path) -> dict[str, Any]:
    """Run the program in a process of that many lanes."""
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(checkpoint)],
        cwd=Path(__file__).parents[3],
        env=os.environ | {"JOINTPLAY_LANES": lanes},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    found: dict[str, Any] = json.loads(done.stdout)
    return found


@pytest.mark.long  # compiles the loop for the other width
def test_four_lanes_and_eight_give_the_same_bits_and_take_each_others_checkpoints(
    tmp_path: Path,
) -> None:
    eight = run("8", tmp_path / "by-eight")
    four = run("4", tmp_path / "by-eight")
    assert (eight["lanes"], four["lanes"]) == (8, 4)
    assert eight["onsets"] > 20
    assert four["whole"] == eight["whole"]
    assert four["rest"] == eight["rest"]
    again = run("4", tmp_path / "by-four")
    assert run("8", tmp_path / "by-four")["rest"] == again["rest"]


@pytest.mark.parametrize("lanes", ["2", "16", "eight"])
def test_another_number_of_lanes_is_refused_with_a_sentence(lanes: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", "import jointplay.solver.kernels.lanes"],
        env=os.environ | {"JOINTPLAY_LANES": lanes},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 1
    assert f"It is '{lanes}'; it must be 4 (vectors of 256 bits) or 8 (512 bits)" in done.stderr


PROCESSORS = {"x86_64": {"haswell": 4, "x86-64-v4": 8, "generic": 4}, "aarch64": {"generic": 4}}


def test_the_width_is_that_of_the_processor_that_is_compiled_for() -> None:
    for processor, lanes in PROCESSORS[os.uname().machine].items():
        chosen = {"NUMBA_CPU_NAME": processor, "NUMBA_CPU_FEATURES": "", "JOINTPLAY_LANES": ""}
        done = subprocess.run(
            [
                sys.executable,
                "-c",
                "from jointplay.solver.kernels.lanes import LANES; print(LANES)",
            ],
            env=os.environ | chosen,
            capture_output=True,
            text=True,
            check=True,
        )
        assert int(done.stdout) == lanes, processor
