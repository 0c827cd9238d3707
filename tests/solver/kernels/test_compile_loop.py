"""The integration loop is compiled apart from mechanisms: all of it, by another process."""

import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from jointplay.solver.kernels import compile_loop, loop_code
from jointplay.solver.kernels.entry_point import EntryPoint
from jointplay.solver.kernels.loop import entry_points
from jointplay.solver.kernels.target import own_target

PROGRAM = """
import sys
from jointplay.solver.kinds import admit
from jointplay.solver.runs.dense_output.columns import method_of
from jointplay.solver.runs.dense_output.replay import Replay
from jointplay.solver.runs.simulate import Simulation

admitted = admit({"kind": "simulate", "scene": {"preset": "bouncing-journal"}, "duration": 0.1})
(piece, *_) = Simulation(admitted).slices()
replay = Replay(admitted, method_of(piece.steps[0, -1]))
replay.mismatch(piece.steps[:, :-1].copy())
print(*(name for name in ("numba", "scipy.linalg") if name in sys.modules))
"""


def test_what_every_entry_point_does_is_compiled() -> None:
    known = {one for one in vars(entry_points).values() if isinstance(one, EntryPoint)}
    assert known == {one for part in compile_loop.FUNCTIONS.values() for one in part}
    for part, functions in compile_loop.FUNCTIONS.items():
        for one, function in functions.items():
            assert one.name == function.__name__
            assert loop_code.address_in(part, one.symbol) > 0


def test_a_process_that_computes_never_loads_the_compiler_of_the_loop() -> None:
    ended = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True)
    assert ended.stdout.split() == [], ended.stderr


def test_what_is_compiled_already_is_left(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(loop_code, "cache_folder", lambda: tmp_path)
    monkeypatch.setattr(compile_loop, "code_of", lambda part: part.encode())
    for part in loop_code.PARTS:
        compile_loop.compile_part(part)
        assert loop_code.path_of(part).read_text() == part
        assert loop_code.begin(part) is None
    monkeypatch.setattr(compile_loop, "code_of", None)  # nothing can be compiled any more
    monkeypatch.setattr(loop_code, "subprocess", None)
    assert compile_loop.main(list(loop_code.PARTS)) == compile_loop.main([]) == 0
    loop_code.path_of(loop_code.RUNS).unlink()
    with pytest.raises(TypeError):
        compile_loop.main([loop_code.RUNS])
    with pytest.raises(AttributeError):
        compile_loop.main([])


def test_it_is_compiled_for_each_processor_and_the_same_for_every_width(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    own, target = loop_code.path_of(loop_code.RUNS), own_target()
    monkeypatch.setattr(loop_code, "own_target", lambda: replace(target, lanes=2))
    assert loop_code.path_of(loop_code.RUNS) == own
    monkeypatch.setattr(loop_code, "own_target", lambda: replace(target, processor="another"))
    assert loop_code.path_of(loop_code.RUNS) != own


def test_a_loop_that_cannot_be_compiled_says_where_to_look(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(loop_code, "path_of", lambda part: tmp_path / part)
    monkeypatch.setattr(loop_code, "begin", lambda part: subprocess.Popen(["false"]))
    with pytest.raises(RuntimeError, match=r"compile_loop anything says why"):
        loop_code.address_in("anything", "jointplay.advance")


@pytest.mark.parametrize(
    "wrong",
    [
        np.zeros((2, 3), np.float32),
        np.zeros(6),
        np.zeros((2, 6))[:, ::2],
        np.zeros((3, 2)).T,
    ],
)
def test_an_entry_point_takes_arrays_of_its_own_kind_alone(wrong: Any) -> None:
    with pytest.raises(TypeError, match="a contiguous array of 2 dimensions of float64 is wanted"):
        list(entry_points.WORK.passed(wrong))


THREADS = """
import threading
from jointplay.solver.kernels.loop.entry_points import EntryPoint
from jointplay.solver.kernels.loop import entry_points

known = [one for one in vars(entry_points).values() if isinstance(one, EntryPoint)]
together, found = threading.Barrier(8), []

def look():
    together.wait()
    found.append(tuple(one.address(one.symbol) for one in known))

threads = [threading.Thread(target=look) for _ in range(8)]
for each in threads:
    each.start()
for each in threads:
    each.join()
print(len(found), len(set(found)), all(found[0]))
"""


def test_threads_that_compute_at_once_share_one_loop() -> None:
    ended = subprocess.run([sys.executable, "-c", THREADS], capture_output=True, text=True)
    assert ended.stdout.split() == ["8", "1", "True"], ended.stderr
