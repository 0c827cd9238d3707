"""Whether a device serves: a mechanism's bits there and here, and how fast they come."""

import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.kernels.device.driver import Device
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.layout import BUNDLE
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.device_bundle import DeviceBundle
from jointplay.solver.runs.trial_pace import ATTEMPTS, trial_problems
from jointplay.solver.scene.document import Scene

LANES = 512
"""Lanes a multiprocessor of the device: two are computed while others wait for memory."""
HIGHEST_RATIO = 4
"""A device serves whose rate in double precision is at least a quarter of that in single."""


@dataclass(frozen=True)
class DeviceTrial:
    """A device that was tried."""

    name: str
    ratio: int
    """Operations in single precision that it makes in the time of one in double."""
    same_bits: bool
    revolutions: float
    """A second, of the mechanism's crank, in all lanes."""
    steps: float
    """Accepted ones a second, in all lanes."""

    @property
    def serves(self) -> bool:
        """Whether it has this processor's bits, and is made for double precision."""
        return self.same_bits and self.ratio <= HIGHEST_RATIO


def try_device(device: Device, scenes: Sequence[Scene], lanes: int | None = None) -> DeviceTrial:
    """Run a mechanism on a device and here; some seconds, and the time that compiling takes.

    Parameters
    ----------
    scenes
        Of one structure, as many as a bundle has lanes.
    lanes
        By default as many as the device is good for.

    Raises
    ------
    DeviceError
        The device does not do it.
    """
    lanes = lanes or LANES * device.processors
    problems = trial_problems(scenes)
    kernel = ready_kernel(problems[0].scene, "reduced")
    here = Bundle(kernel, problems, watch=False)
    there = DeviceBundle(device, kernel, lanes)
    try:
        for i, problem in enumerate(problems):
            there.load(i, problem)
        there.repeat(BUNDLE)
        there.advance(ATTEMPTS)
        while here.attempts < ATTEMPTS:
            here.advance(ATTEMPTS - here.attempts)
        same = _same(here, there)
        before, begun = _made(there), time.perf_counter()
        there.advance(ATTEMPTS)
        seconds = time.perf_counter() - begun
        revolutions, steps = (_made(there) - before) / seconds
    finally:
        there.release()
    return DeviceTrial(device.name, device.ratio, same, float(revolutions), float(steps))


def _same(here: Bundle, there: DeviceBundle) -> bool:
    """Return whether the first lanes there have the bits of those here."""
    times = all((there.lane(i)["time"] == here.lane(i)["time"]).all() for i in range(BUNDLE))
    state = there.state("there")["there/work"][here.kernel.layout.block("y"), :BUNDLE]
    return times and bool((state == here.block("y")).all())


def _made(bundle: DeviceBundle) -> Floats:
    """Return the revolutions and the accepted steps of all lanes, (2,)."""
    steps = bundle.groups[0].work[bundle.kernel.layout["steps"]]
    return np.array([(bundle.now() / bundle.runs["unit"]).sum(), steps.sum()])
