"""The task a worker runs, and what its processes do when they start and stop."""

import logging
import os
import signal
import threading
import time
from contextlib import closing, suppress
from functools import lru_cache
from multiprocessing import Pipe, get_context
from multiprocessing.connection import Connection
from typing import Any

from billiard.process import active_children
from celery.signals import setup_logging, worker_init, worker_process_init, worker_shutting_down

from jointplay.records.failure import InvalidInput
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Unavailable
from jointplay.storage.catalogue.records import Claim
from jointplay.storage.installation import OtherFiles, require_own_files
from jointplay.storage.settings import Settings
from jointplay.worker.app import RUN_BLOCK, app
from jointplay.worker.local.devices import Lanes, opener
from jointplay.worker.own_device import OwnDevice, tried_device
from jointplay.worker.own_solver import own_solver
from jointplay.worker.process_name import own_name
from jointplay.worker.scratch.computing import (
    compute,  # before the fork: all children share the solver
)
from jointplay.worker.spent import SpentReport
from jointplay.worker.wake_up import wake_relay

_log = logging.getLogger(__name__)
_draining = threading.Event()
_device: OwnDevice | None = None
"""None: there is none, or it does not go on: the processor computes."""
_DRAIN_SIGNAL = signal.SIGUSR2
_LOOK_AGAIN = 0.2  # s


@lru_cache(maxsize=1)
def _platform() -> tuple[Settings, Catalogue]:
    """Return this process's settings and catalogue; never made before the fork."""
    settings = Settings()
    return settings, Catalogue(settings.catalogue_url)


@app.task(name=RUN_BLOCK)  # type: ignore[untyped-decorator]
def run_block(block: str) -> None:
    """Compute the block whose turn it is, be it another one; a redundant message does nothing."""
    settings, catalogue = _platform()
    if _draining.is_set():
        return
    solver = own_solver()
    try:
        claim = catalogue.claim_next(
            own_name(), settings.lease, solver, most_running=settings.most_running
        )
    except Unavailable as fault:
        _log.warning("block %s is not claimed, its wake-up comes again: %s", block, fault)
        return
    if claim is None or claim.block.id != block:
        try:
            catalogue.wake_again(block, solver)
        except Unavailable as fault:
            _log.warning("the wake-up of block %s comes again later: %s", block, fault)
    if claim is not None:
        if claim.block.id != block:
            wake_relay(settings.redis_url)  # somebody else may be free for that one
        if _device is None:
            compute(catalogue, settings, claim, _draining)
        else:
            _compute_on(opener(_device.name), claim)
        if settings.most_running:
            wake_relay(settings.redis_url)  # its owner may have another block computed


def _compute_on(device: Lanes, claim: Claim) -> None:
    """Compute a block, and others beside it, on this process's device."""
    from jointplay.solver.kernels.device.driver import DeviceError
    from jointplay.worker.device_run import compute_on_device
    from jointplay.worker.own_blocks import OwnBlocks

    global _device
    settings, catalogue = _platform()
    try:
        compute_on_device(OwnBlocks(catalogue, settings, _draining), claim, _draining, device)
    except DeviceError as error:
        _device = None
        _log.error("from now on the processor computes, for the device does not go on: %s", error)


@setup_logging.connect  # type: ignore[untyped-decorator]
def _set_up_no_other_logs(**_: Any) -> None:
    """Have Celery write where the program has begun to: it sets up nothing if somebody listens."""


@worker_init.connect  # type: ignore[untyped-decorator]
def _prepare(**_: Any) -> None:
    """Before the fork: wait until an API or a relay has brought the schema up to date.

    Another process looks at files and device: what has asked a bucket has threads that no fork
    takes along, for which the children would wait for ever, nor does it take an open device along.
    """
    global _device
    settings = Settings()
    with closing(Catalogue(settings.catalogue_url)) as catalogue:
        while not _is_migrated(catalogue):
            time.sleep(_LOOK_AGAIN)
    found, finds = Pipe(duplex=False)
    processes = app.conf.worker_concurrency or 1
    looking = get_context("fork").Process(target=_look, args=(settings, processes, finds))
    looking.start()
    finds.close()
    with suppress(EOFError):  # it says why
        _device = found.recv()
    looking.join()
    if looking.exitcode:
        raise SystemExit(1)


def _look(settings: Settings, processes: int, finds: Connection) -> None:
    try:
        finds.send(tried_device(settings.device, processes))
    except InvalidInput as error:
        detail = error.problems[0].detail
        raise SystemExit(f"the worker does not start: JOINTPLAY_DEVICE {detail}") from None
    with closing(Catalogue(settings.catalogue_url)) as catalogue:
        try:
            require_own_files(settings, catalogue)
        except (OtherFiles, Unavailable) as error:
            raise SystemExit(f"the worker does not start: {error}") from None


def _is_migrated(catalogue: Catalogue) -> bool:
    try:
        return catalogue.is_migrated()
    except Unavailable as fault:
        _log.warning("waiting: %s", fault)
        return False


@worker_process_init.connect  # type: ignore[untyped-decorator]
def _listen_for_drain(**_: Any) -> None:
    signal.signal(_DRAIN_SIGNAL, lambda *_: _draining.set())
    threading.Thread(target=_be_present, name="presence", daemon=True).start()


def _be_present() -> None:
    """Tell the catalogue now and then that there is a worker with this solver, and its device."""
    settings, catalogue = _platform()
    spent_report = SpentReport()
    while True:
        try:
            record = None if _device is None else _device.record
            catalogue.note_worker(own_name(), own_solver(), record)
            spent_report.send(catalogue, own_name())
        except Unavailable as fault:
            _log.debug("not known to be there: %s", fault)
        except Exception:  # noqa: BLE001 - it is told for as long as the process lives
            _log.exception("not known to be there")
        time.sleep(settings.heartbeat)


@worker_shutting_down.connect  # type: ignore[untyped-decorator]
def _drain(**_: Any) -> None:
    """On SIGTERM: have every child give its block back at the end of the present slice."""
    for child in active_children():
        os.kill(child.pid, _DRAIN_SIGNAL)
