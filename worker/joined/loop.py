"""Claiming and computing blocks, one after the other, until there are no more or time is over."""

import logging
import random
import time
from importlib.metadata import version
from threading import Event
from typing import Final

from jointplay.storage.catalogue.errors import Fenced, Unavailable
from jointplay.storage.catalogue.records import Claim
from jointplay.worker.joined.bucket import BucketOfService
from jointplay.worker.joined.computing import JoinedBlocks
from jointplay.worker.joined.connection import Connection
from jointplay.worker.joined.protocol import ClaimRequest, Device
from jointplay.worker.local.devices import Lanes, opener
from jointplay.worker.own_device import OwnDevice
from jointplay.worker.own_solver import own_solver
from jointplay.worker.process_name import own_name
from jointplay.worker.spent import SpentReport

_WAIT: Final = 5.0  # s, for a block, until it is looked whether to go on
_FIRST_PAUSE, _LONGEST_PAUSE = 0.5, _WAIT
"""Seconds before a service that is away is asked again: as often as by those who have no work."""
_log = logging.getLogger(__name__)


class _DeviceFailed(Exception):
    """The device cannot be opened, or does not go on."""


def work(
    connection: Connection, draining: Event, idle: float | None, device: OwnDevice | None = None
) -> int:
    """Compute blocks until `draining` is set, or there was none for `idle` seconds; count them.

    Points of studies are computed by the device, if there is one, until that does not go on.

    Raises
    ------
    Refused
        The service does not take this worker.
    """
    solver = own_solver()
    request = ClaimRequest(
        program=version("jointplay"),
        worker=own_name(),
        version=solver.version,
        processor=solver.processor,
        wait=_WAIT if idle is None else min(_WAIT, idle),
    )
    bucket = BucketOfService(connection)
    spent_report = SpentReport()
    last = time.monotonic()
    pause = _FIRST_PAUSE
    blocks = 0
    while not draining.is_set() and (idle is None or time.monotonic() - last <= idle):
        try:
            spent = spent_report.unsent()
            record = None if device is None else Device(**vars(device.record))
            asked = request.model_copy(update={"spent": spent, "device": record})
            claimed = connection.claim(asked)
            spent_report.note_sent(spent)
            if claimed is not None:
                source = JoinedBlocks(connection, bucket, claimed.customs, draining)
                lanes = None if device is None else opener(device.name)
                blocks += _computed(source, claimed.claim, lanes, draining)
                last = time.monotonic()
            pause = _FIRST_PAUSE
        except _DeviceFailed as error:
            device, last = None, time.monotonic()
            _log.error("from now on the processor computes, for the device fails: %s", error)
        except Fenced as fenced:
            _log.warning("%s; leaving it", fenced)
        except Unavailable as fault:
            _log.warning("asking again: %s", fault)
            draining.wait(pause * random.uniform(0.5, 1.0))  # noqa: S311 - not all at once
            pause = min(2 * pause, _LONGEST_PAUSE)
    return blocks


def _computed(blocks: JoinedBlocks, claim: Claim, device: Lanes | None, draining: Event) -> int:
    """Compute a block, with a device maybe others beside it.

    Returns how many it computed. Raises `_DeviceFailed`.
    """
    if device is None:
        blocks.compute(claim)
        return 1
    from jointplay.solver.kernels.device.driver import DeviceError
    from jointplay.worker.device_run import compute_on_device

    try:
        return compute_on_device(blocks, claim, draining, device)
    except DeviceError as error:
        raise _DeviceFailed(str(error)) from error
