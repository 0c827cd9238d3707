"""A long tape, cut into pieces, does what it does as a whole."""

import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from numba import njit
from numpy.typing import NDArray

from jointplay.solver.integrators import AUTO
from jointplay.solver.kernels.emit.kernel import Kernel, compile_kernel
from jointplay.solver.kernels.emit.pieces import cut
from jointplay.solver.kernels.emit.straight_line import straight_line
from jointplay.solver.kernels.lanes import LANES
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.record.operations import OPERATIONS
from jointplay.solver.kinds import admit
from jointplay.solver.mechanics.tree import spanning_tree

TAPES = re.compile(
    r'^(\w+)_tape = straight_line\("""\n(.*?)\n""", "(\w+)"', re.DOTALL | re.MULTILINE
)
KEEPING = re.compile("^keep | kept ")
WHOLE = 10**6


@cache
def kernel(preset: str, formulation: str) -> Kernel:
    job = {"kind": "simulate", "scene": {"preset": preset}, "duration": 0.1}
    scene = admit(job | {"formulation": formulation}).scene
    return compile_kernel(scene, spanning_tree(scene), formulation, AUTO)


def tape_of(kernel: Kernel, function: str) -> tuple[str, str]:
    """Return a function's tape, and what it goes over."""
    source = Path(str(kernel.module.__file__)).read_text()
    return next((tape, over) for name, tape, over in TAPES.findall(source) if name == function)


def on_floats(pieces: list[list[str]]) -> list[tuple[str, float]]:
    """Return what pieces store, in their order; slot k holds a number that k tells."""
    stored: list[tuple[str, float]] = []
    kept: dict[str, float] = {}
    for piece in pieces:
        values: dict[str, float] = {}
        for line in piece:
            match line.replace("= ", "").split():
                case ["store", slot, value]:
                    stored.append((slot, values[value] if value in values else float(value)))
                case ["keep", place, value]:
                    kept[place] = values[value]
                case [name, "kept", place]:
                    values[name] = kept[place]
                case [name, "load", slot]:
                    values[name] = 1.0 + 1.0 / (1.0 + float(slot))
                case [name, operation, *operands]:
                    numbers = [values[o] if o in values else float(o) for o in operands]
                    values[name] = OPERATIONS[operation].on_floats(*numbers)
    return stored


@pytest.mark.parametrize("longest", [5, 40, 200])
@pytest.mark.parametrize("function", ["slopes", "right_hand_side", "observe"])
def test_pieces_compute_what_the_whole_does(function: str, longest: int) -> None:
    tape, _ = tape_of(kernel("slider-crank", "reduced"), function)
    pieces, places = cut(tape.splitlines(), longest)
    assert len(pieces) > 1
    assert all(sum(not KEEPING.search(line) for line in piece) <= longest for piece in pieces)
    assert 0 < places < len(tape.splitlines()) / 2
    assert on_floats(pieces) == on_floats([tape.splitlines()])


@pytest.mark.parametrize(
    ("preset", "formulation", "function", "longest"),
    [
        ("slider-crank", "reduced", "slopes", 40),
        ("slider-crank", "reduced", "judge", 100),
        ("slider-crank", "reduced", "channels_around", 150),
        *(
            pytest.param(preset, formulation, function, longest, marks=pytest.mark.long)
            for preset, formulation in (("seven-bar-press", "lagrange"), ("n-four-bar", "reduced"))
            for function in ("slopes", "right_hand_side", "judge", "take", "channels_within")
            for longest in (50, 400)
        ),
    ],
)
def test_compiled_pieces_do_what_the_whole_does(
    preset: str, formulation: str, function: str, longest: int
) -> None:
    scene_kernel = kernel(preset, formulation)
    tape, over = tape_of(scene_kernel, function)
    results: list[NDArray[np.float64]] = []
    for most in (WHOLE, longest):
        run = straight_line(tape, over, 0, most)
        compiled = njit(lambda work, target, index, run=run: run(work, target, index))
        random = np.random.default_rng(3)
        work = random.uniform(0.5, 1.5, (scene_kernel.layout.size + 1, LANES))
        target = random.uniform(0.5, 1.5, (len(work), INSTANTS)) if over == "instants" else work
        value = compiled(work, target, 1)
        results.append(np.append(target.ravel(), 0.0 if value is None else value))
    whole, in_pieces = results
    assert np.isfinite(whole).mean() > 0.9
    np.testing.assert_allclose(in_pieces, whole, rtol=1e-8)


def test_a_piece_ends_where_little_has_to_be_kept() -> None:
    one = "v0 = load 0\nv1 = load 1\nv2 = add v0 v1\nstore 2 v2".splitlines()
    other = "v4 = load 3\nv5 = load 4\nv6 = mul v4 v5\nstore 5 v6".splitlines()
    assert cut([*one, *other], 6) == ([one, other], 0)


def test_a_place_is_taken_again_when_nothing_reads_it_any_more() -> None:
    tape = "v0 = load 0\nstore 1 v0\nv1 = load 2\nstore 3 v0\nstore 4 v1\nstore 5 v1".splitlines()
    pieces, places = cut(tape, 2)
    assert places <= 2
    assert on_floats(pieces) == on_floats([tape])
