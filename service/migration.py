"""Bringing the catalogue up to date as the service starts, however long that cannot be done."""

import asyncio
import logging

from fastapi.concurrency import run_in_threadpool

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Unavailable

_PAUSE = 1.0  # s
_log = logging.getLogger(__name__)


async def migrated(catalogue: Catalogue, *, patient: bool) -> "asyncio.Task[None]":
    """Return the task that is done once the catalogue is up to date, most often at once.

    Raises `Unavailable` where it cannot be brought there now, unless this is `patient`: the task
    tries again then, and meanwhile requests are refused by what they ask of the catalogue.
    """
    try:
        await run_in_threadpool(catalogue.migrate)
    except Unavailable as error:
        if not patient:
            raise
        _log.warning("trying again: %s", error)
        return asyncio.create_task(_tried_again(catalogue))
    return asyncio.create_task(asyncio.sleep(0.0))


async def _tried_again(catalogue: Catalogue) -> None:
    while True:
        await asyncio.sleep(_PAUSE)
        try:
            await run_in_threadpool(catalogue.migrate)
        except Unavailable as error:
            _log.debug("trying again: %s", error)
        else:
            return
