"""The device of a worker: it is tried before blocks are taken, and told with its rate."""

import logging
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from jointplay.records.failure import InvalidInput
from jointplay.storage.catalogue.records import WorkerDevice
from jointplay.worker.local.devices import FIRST, PROCESSOR

if TYPE_CHECKING:
    from jointplay.solver.runs.device_trial import DeviceTrial
    from jointplay.solver.scene.document import Scene

TRIED = "slider-crank"
"""Preset by which a device is tried."""
_NAME = 64
"""Characters of a device's name that are kept."""
_log = logging.getLogger(__name__)


@dataclass(frozen=True)
class OwnDevice:
    """A device that has the bits of this processor."""

    name: str
    """Such as ``cuda:0``."""
    record: WorkerDevice


def tried_device(name: str, processes: int = 1) -> OwnDevice | None:
    """Return the device of a name, once it was tried for some seconds; None: the processor serves.

    Each of so many `processes`, which share it, tells of its part.

    Raises
    ------
    InvalidInput
        There is no device of the name, or it has other bits. Where the name is `FIRST` the log
        says so.
    """
    if name == PROCESSOR:
        return None
    if name != FIRST:
        return _tried(name, processes)
    from jointplay.solver.runs.found_device import found_device

    found = found_device()
    try:
        return None if found is None else _tried(found, processes)
    except InvalidInput as error:
        _log.warning("the processor computes: %s", error)
        return None


def _tried(name: str, processes: int) -> OwnDevice:
    from jointplay.solver.kernels.device.driver import DeviceError
    from jointplay.solver.kernels.device.lanes import BLOCK
    from jointplay.solver.kernels.device.named import device_named
    from jointplay.solver.runs.device_trial import try_device

    device = device_named(name)
    try:
        trial = try_device(device, [*trial_scenes()])
    except DeviceError as error:
        raise InvalidInput.at("/device", f"{name!r} does not go on: {error}.") from error
    return of_trial(name, trial, BLOCK * device.processors, processes)


def of_trial(name: str, trial: "DeviceTrial", lanes: int, processes: int = 1) -> OwnDevice:
    """Return a device that was tried, and has so many lanes; InvalidInput if it has other bits."""
    if not trial.same_bits:
        detail = f"{name!r}, {trial.name}, has other bits than this processor."
        raise InvalidInput.at("/device", detail)
    _log.info("%s, %s, makes %.3g steps a second", name, trial.name, trial.steps)
    record = WorkerDevice(trial.name[:_NAME], trial.steps / processes, max(lanes // processes, 1))
    return OwnDevice(name, record)


def trial_scenes() -> "Iterator[Scene]":
    """Yield a bundle of mechanisms of one structure."""
    from jointplay.solver.kernels.layout import BUNDLE
    from jointplay.solver.kinds import admit
    from jointplay.solver.runs.admission import Admission
    from jointplay.solver.scene.document import Scene

    for k in range(BUNDLE):
        given = {"preset": TRIED, "parameters": {"clearance": 1e-4 * (1 + k / 2)}}
        admitted = admit({"kind": "simulate", "scene": given, "duration": 1.0})
        assert isinstance(admitted, Admission)  # noqa: S101  (narrows the type)
        yield Scene.model_validate(admitted.scene)
