"""Lanes of a device have the bits of eight lanes here: this processor does what the driver does."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

from jointplay.records.failure import InvalidInput
from jointplay.solver.kernels.device.driver import Device, DeviceError
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.emit.tangents import compile_tangents
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.layout import BUNDLE
from jointplay.solver.kernels.loop.runs import SAMPLES, SECTIONS, SectionKind, Status
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.device_bundle import DeviceBundle
from jointplay.solver.lanes.problem import Event, LaneProblem
from tests.solver.kernels.device.driver_by_host import DriverByHost
from tests.solver.readable_mechanics import preset

MOVING = {"seven-bar-press": 0.3, "slider-crank": 0.1, "four-bar": 0.2}
"""Seconds in which each makes more attempts than `FIRST`, and has contacts."""
FIRST = 600
SCRATCH = ("potential", "stored")
"""Slots that are written for all lanes of a group whenever one of them wants it."""


def problems(name: str, seconds: float) -> list[LaneProblem]:
    """Return eight runs of other clearances, with samples and the sections that there are."""
    found = []
    for clearance in np.linspace(3e-4, 6e-4, BUNDLE):
        scene = preset(name, clearance=float(clearance))
        found.append(LaneProblem(scene, seconds, 1e-6, seconds / 30, 31, 2**40, 0.0))
    return found


def kernel_of(name: str) -> Kernel:
    return ready_kernel(preset(name), "reduced", "tsitouras")


def on_device(kernel: Kernel, count: int = BUNDLE, **more: Any) -> DeviceBundle:
    device = Device(library=more.pop("library", None) or DriverByHost())
    return DeviceBundle(device, kernel, count, **more)


def handed_out(bundle: Bundle, budget: int) -> list[list[bytes]]:
    """Advance until all of eight lanes are done; return all that they have handed out."""
    found: list[list[list[bytes]]] = [[] for _ in range(BUNDLE)]
    running = BUNDLE
    while running:
        running = bundle.advance(budget)
        for i in range(BUNDLE):
            parts = [bundle.rows(SAMPLES, i), bundle.rows(SECTIONS, i), bundle.impacts(i)]
            parts += [bundle.growth(i)] if bundle.tangents else []
            found[i].append([part.tobytes() for part in parts])
    return [[b"".join(parts) for parts in zip(*one, strict=True)] for one in found]


def loaded(bundle: DeviceBundle, given: Sequence[LaneProblem]) -> DeviceBundle:
    for i, problem in enumerate(given):
        bundle.load(i, problem)
    return bundle


def numbers(bundle: Bundle) -> Any:
    """Return all quantities of all lanes but `SCRATCH`, as words."""
    work = bundle.state("lanes")["lanes/work"]
    kept = np.setdiff1d(np.arange(len(work)), [bundle.kernel.layout[name] for name in SCRATCH])
    return work[kept].view(np.int64)


@pytest.mark.parametrize("name", MOVING)
def test_a_device_has_the_bits_of_eight_lanes(name: str) -> None:
    kernel, given = kernel_of(name), problems(name, MOVING[name])
    here, there = Bundle(kernel, given, watch=False), loaded(on_device(kernel), given)
    while here.attempts < FIRST and here.runs["status"].max() == Status.RUNNING:
        here.advance(FIRST - here.attempts)
    for budget in (FIRST - 100, 100):
        assert there.advance(budget) == BUNDLE
    np.testing.assert_array_equal(numbers(there), numbers(here))
    assert handed_out(there, 700) == handed_out(here, 1000)
    assert here.runs["onsets"].sum() > BUNDLE
    for field in ("onsets", "rejections", "attended", "periods"):
        np.testing.assert_array_equal(there.runs[field], here.runs[field])


def test_tangents_grow_by_the_same_bits() -> None:
    kernel, given = kernel_of("slider-crank"), problems("slider-crank", 0.1)
    tangents = compile_tangents(kernel)
    here = Bundle(kernel, given, watch=False, tangents=tangents)
    there = loaded(on_device(kernel, tangents=tangents), given)
    grown = handed_out(here, 1000)
    assert handed_out(there, 900) == grown
    assert all(len(lane[-1]) >= 16 for lane in grown)


def test_a_run_moves_to_the_device_and_back() -> None:
    kernel, given = kernel_of("slider-crank"), problems("slider-crank", 0.1)
    straight = Bundle(kernel, given, watch=False)
    expected = handed_out(straight, 10_000)
    here, there = Bundle(kernel, given, watch=False), on_device(kernel)
    found = [b""] * BUNDLE
    for one, other in ((here, there), (there, here)):
        assert one.advance(500) == BUNDLE
        found = [f + one.rows(SAMPLES, i).tobytes() for i, f in enumerate(found)]
        other.restore(one.state("lanes"), "lanes")
    rest = handed_out(here, 10_000)
    assert [f + r[0] for f, r in zip(found, rest, strict=True)] == [e[0] for e in expected]


def test_a_free_lane_takes_another_problem_and_the_others_do_not_notice() -> None:
    kernel = kernel_of("slider-crank")
    short, long = problems("slider-crank", 0.01), problems("slider-crank", 0.05)
    there = loaded(on_device(kernel, 2), [short[0], long[1]])
    while there.advance(300) == 2:
        pass
    assert not there.lane(0).running
    there.load(0, long[0])
    while there.advance(300):
        pass
    here = Bundle(kernel, long[:2], watch=False)
    while here.advance(1000):
        pass
    np.testing.assert_array_equal(there.block("y"), here.block("y")[:, :2])


def test_a_lane_moves_alone_to_another_place_of_a_device_and_back() -> None:
    kernel, given = kernel_of("slider-crank"), problems("slider-crank", 0.05)
    here, there, last = Bundle(kernel, given[:2], watch=False), on_device(kernel, 3), None
    assert here.advance(300) == 2
    there.take_up(2, *here.states_of([1])[0])
    there.load(0, given[5])
    assert there.advance(300) == 2
    last = Bundle(kernel, watch=False)
    last.take_up(4, *there.states_of([2])[0])
    for bundle in (here, last):
        while bundle.advance(10_000):
            pass
    np.testing.assert_array_equal(last.lane(4)["y"], here.lane(1)["y"])
    assert last.lane(4).steps == here.lane(1).steps


def test_of_lanes_that_run_on_little_is_fetched() -> None:
    kernel, driver = kernel_of("slider-crank"), DriverByHost()
    short, long = problems("slider-crank", 0.005), problems("slider-crank", 0.05)
    there = loaded(on_device(kernel, 64, library=driver), [short[0], *long[1:]])
    while there.lane(0).running:
        before = driver.fetched
        there.advance(100)
    assert driver.fetched - before < 64 * kernel.layout.size * 8 / 2


def test_what_no_device_does_is_refused() -> None:
    stiff = ready_kernel(preset("slider-crank"), "reduced", "rodas")
    with pytest.raises(InvalidInput, match="explicit"):
        on_device(stiff)
    there = on_device(kernel_of("slider-crank"), 1)
    crossing = Event(SectionKind.CROSSING, 0)
    problem = LaneProblem(preset("slider-crank"), 1.0, 1e-6, 1.0, 2, 1, 0.0, event=crossing)
    with pytest.raises(InvalidInput, match="onsets"):
        there.load(0, problem)


def test_a_device_without_room_says_so_and_keeps_nothing() -> None:
    driver = DriverByHost(memory=2**20)
    with pytest.raises(DeviceError, match="OUT_OF_MEMORY"):
        on_device(kernel_of("slider-crank"), 1000, library=driver)
    assert not driver.held


def test_a_lost_device_is_told_and_what_was_saved_goes_on_here() -> None:
    kernel, given = kernel_of("slider-crank"), problems("slider-crank", 0.1)
    driver = DriverByHost()
    there = loaded(on_device(kernel, library=driver), given)
    assert there.advance(400) == BUNDLE
    saved = {name: array.copy() for name, array in there.state("lanes").items()}
    driver.lost_at = driver.launches
    with pytest.raises(DeviceError, match="cuLaunchKernel: CUDA_ERROR_LAUNCH_FAILED"):
        there.advance(400)
    here, straight = Bundle(kernel, watch=False), Bundle(kernel, given, watch=False)
    here.restore(saved, "lanes")
    for bundle in (here, straight):
        while bundle.advance(10_000):
            pass
    np.testing.assert_array_equal(here.block("y"), straight.block("y"))


def test_without_a_driver_there_is_a_sentence() -> None:
    with pytest.raises(DeviceError, match="no driver of a device"):
        Device(name="libcuda.so.none")
