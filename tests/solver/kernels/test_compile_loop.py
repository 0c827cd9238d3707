"""The integration loop is compiled apart from mechanisms: all of it, by another process."""

import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from jointplay.solver.kernels import compile_loop, loop_code, watched
from jointplay.solver.kernels.emit import machine_code, slots
from jointplay.solver.kernels.entry_point import EntryPoint
from jointplay.solver.kernels.loop import entry_points
from jointplay.solver.kernels.target import own_target
from jointplay.solver.kernels.watched import CompilationTooLong

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
    monkeypatch.setattr(machine_code, "_loaded", set())
    for part in loop_code.PARTS:
        compile_loop.compile_part(part)
        assert loop_code.path_of(part).read_text() == part
        assert loop_code.begin(part) is None
    monkeypatch.setattr(compile_loop, "code_of", None)  # nothing can be compiled any more
    monkeypatch.setattr(loop_code, "subprocess", None)
    assert compile_loop.main(list(loop_code.PARTS)) == compile_loop.main([]) == 0
    loop_code.path_of(loop_code.FOR_RUNS).unlink()
    with pytest.raises(TypeError):
        compile_loop.main([loop_code.FOR_RUNS])
    with pytest.raises(AttributeError):
        compile_loop.main([])


def test_it_is_compiled_for_each_processor_and_the_same_for_every_width(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    own, target = loop_code.path_of(loop_code.FOR_RUNS), own_target()
    monkeypatch.setattr(loop_code, "own_target", lambda: replace(target, lanes=2))
    assert loop_code.path_of(loop_code.FOR_RUNS) == own
    monkeypatch.setattr(loop_code, "own_target", lambda: replace(target, processor="another"))
    assert loop_code.path_of(loop_code.FOR_RUNS) != own


@pytest.mark.parametrize(
    ("command", "kind", "words"),
    [
        ("exit 1", RuntimeError, "could not be compiled"),
        ("kill -9 $$", CompilationTooLong, "killed, by signal 9"),
    ],
)
def test_a_loop_that_is_not_compiled_is_told_and_not_begun_again(
    command: str, kind: type[Exception], words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun = []

    def begin(part: str) -> subprocess.Popen[bytes]:
        begun.append(part)
        return subprocess.Popen(["sh", "-c", command])

    monkeypatch.setattr(loop_code, "begin", begin)
    with pytest.raises(kind, match=words):
        loop_code.address_in("anything", "jointplay.advance")
    assert begun == ["anything"]


def test_a_loop_that_takes_too_long_to_compile_is_not_blamed_on_the_scene() -> None:
    with subprocess.Popen(["sleep", "1000"]) as compiling:
        with (
            pytest.raises(CompilationTooLong, match="Compiling the integration loop") as ended,
            watched.watched(lambda: None, 0.0),
        ):
            loop_code.wait_for(compiling)
        compiling.kill()
    assert "kernels.compile_loop`" in str(ended.value)
    assert "bodies" not in str(ended.value)


def test_a_part_that_is_loaded_is_not_compiled_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert loop_code.address_in(loop_code.FOR_RUNS, entry_points.advance.symbol) > 0
    monkeypatch.setattr(loop_code, "cache_folder", lambda: tmp_path)  # as if it had been wiped
    assert loop_code.begin(loop_code.FOR_RUNS) is None


@pytest.mark.parametrize(
    "wrong",
    [
        np.zeros((2, 3), np.float32),
        np.zeros(6),
        np.zeros((2, 6))[:, ::2],
        np.zeros((3, 2)).T,
        np.broadcast_to(np.zeros(3), (2, 3)),
    ],
)
def test_an_entry_point_takes_arrays_of_its_own_kind_alone(wrong: Any) -> None:
    with pytest.raises(TypeError, match="of 2 dimensions of float64 is wanted"):
        entry_points.WORK.passed(wrong)


def test_an_entry_point_takes_whole_numbers_where_these_are_wanted() -> None:
    with pytest.raises(TypeError, match="'measure_tangent' takes other numbers"):
        entry_points.measure_tangent(np.zeros(1, slots.DTYPE), np.zeros((1, 1)), 0.5)


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
