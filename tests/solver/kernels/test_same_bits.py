"""Generated code gives the same bits at every width and on every processor it is compiled for."""

import os
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from jointplay.solver.kernels.emit.emit import Tape
from jointplay.solver.kernels.emit.functions import SIGNATURES, WITHIN_STEP
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.emit.module import load
from jointplay.solver.kernels.emit.tangents import compile_tangents
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.layout import BUNDLE, INSTANTS, Layout
from jointplay.solver.kernels.target import Target, own_target
from jointplay.solver.kernels.trace.tracer import Tracer
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.lane import aligned_zeros
from jointplay.solver.lanes.problem import LaneProblem
from tests.solver.readable_mechanics import preset

OWN = own_target()
OTHER = "x86-64-v3" if os.uname().machine == "x86_64" else "generic"
TARGETS = [Target(lanes, OWN.processor, OWN.features) for lanes in (1, 4, 8)]
TARGETS += [Target(lanes, OTHER, "") for lanes in (1, 4, 8)]
METHODS = ("tsitouras", "rodas")
SAMPLE = ((METHODS[0], TARGETS[0]), (METHODS[0], TARGETS[5]), (METHODS[1], TARGETS[4]))
"""Each method, width and processor at least once: compiling for one takes two seconds."""
WITHIN = [name for name, kind in SIGNATURES.items() if kind is WITHIN_STEP]
OF_LANES = [name for name in SIGNATURES if name not in WITHIN]


@pytest.fixture(scope="module")
def bundle(request: pytest.FixtureRequest) -> Bundle:
    """Return eight runs by a method that have begun, some of them in contact."""
    clearances = np.linspace(1e-4, 5e-4, BUNDLE)
    scenes = [preset("slider-crank", clearance=float(value)) for value in clearances]
    kernel = ready_kernel(scenes[0], "reduced", request.param)
    problems = [LaneProblem(scene, 1e3, 1e-6, 1e3, 0, 0, 0.0) for scene in scenes]
    begun = Bundle(kernel, problems, tangents=compile_tangents(kernel))
    begun.advance(3000)
    assert begun.runs["onsets"].sum() > BUNDLE
    return begun


def results(bundle: Bundle, target: Target) -> Iterator[tuple[str, Any]]:
    """Yield the name of each function and what it leaves in W, and in S, on a target."""
    kernel: Kernel = bundle.kernel
    assert bundle.tangents is not None
    modules = kernel.module, bundle.tangents.module
    run = vars(load([one for each in modules for one in each.sources], target=target))
    whole = np.concatenate([group.work for group in bundle.groups], axis=1)
    count = target.lanes
    parts = [np.ascontiguousarray(whole[:, i : i + count]) for i in range(0, BUNDLE, count)]
    compared = np.full(len(whole), True)
    compared[kernel.layout.block("marked")] = False  # a byte a row, whatever the width
    for name in OF_LANES:
        for part in parts:
            run[name](part)
        yield name, np.concatenate(parts, axis=1)[compared].view(np.int64)
    for name in WITHIN:
        spare = aligned_zeros(kernel.layout.size, INSTANTS)
        spare[kernel.layout["theta"]] = np.linspace(0.0, 1.0, INSTANTS)
        run[name](parts[0], spare, 0)
        yield name, spare.view(np.int64)


@pytest.mark.parametrize(
    ("bundle", "target"),
    [
        pytest.param(
            method,
            target,
            id=f"{method}, {target.processor}, {target.lanes} lanes",
            marks=[] if (method, target) in SAMPLE else [pytest.mark.long],
        )
        for method in METHODS
        for target in TARGETS
    ],
    indirect=["bundle"],
)
def test_every_function_has_the_bits_of_this_processors_own(bundle: Bundle, target: Target) -> None:
    for (name, expected), (_, found) in zip(
        results(bundle, OWN), results(bundle, target), strict=True
    ):
        differing = np.argwhere(expected != found)
        assert not len(differing), (name, differing[:5])


def functions_of_numbers(target: Target) -> Any:
    """Return what sines, powers, logarithms and exponentials are of random numbers."""
    layout, tracer = Layout(), Tracer()
    layout.add("x", "y", *(f"out{i}" for i in range(6)))
    x, y = tracer.variable("x"), tracer.variable("y")
    size = abs(x) + 1e-9
    found = [*x.sine_cosine(), size.power(y), size.logarithm(), y.exponential(), x / size - x * y]
    tape = Tape(layout)
    tape.store([(f"out{i}", one) for i, one in enumerate(found)])
    run, results = load([tape.function("run")], target=target).run, []
    for numbers in np.random.default_rng(1).uniform(-9.0, 9.0, (500, 2, BUNDLE)):
        work = np.zeros((layout.size, BUNDLE))
        work[:2] = numbers
        for i in range(0, BUNDLE, target.lanes):
            part = np.ascontiguousarray(work[:, i : i + target.lanes])
            run(part)
            work[:, i : i + target.lanes] = part
        results.append(work)
    return np.array(results)


@pytest.mark.parametrize("target", TARGETS, ids=lambda t: f"{t.processor}, {t.lanes} lanes")
def test_functions_of_numbers_have_the_same_bits(target: Target) -> None:
    found = functions_of_numbers(target)
    assert np.isfinite(found).all()
    expected = functions_of_numbers(OWN)
    np.testing.assert_array_equal(found.view(np.int64), expected.view(np.int64))
