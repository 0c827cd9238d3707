"""Queueing: what a request asks for is checked and stored, and those who compute it are woken."""

from dataclasses import replace
from typing import Annotated

from fastapi import Depends, Request

from jointplay.service.access import Caller
from jointplay.service.access.quotas import quota_of
from jointplay.service.batches.admission import QueueBatch
from jointplay.service.checking import Checker, CheckJob
from jointplay.service.idempotency import Repeatable, SentKey
from jointplay.service.problems import RequestRefused, kinds
from jointplay.service.workers.bell import Bell
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import Submitted, SubmittedBatch
from jointplay.storage.settings import Settings
from jointplay.worker.wake_up import wake_relay


class Queueing:
    """Queues what callers submit; the application has one."""

    def __init__(
        self, settings: Settings, catalogue: Catalogue, checker: Checker, bell: Bell
    ) -> None:
        self._settings = settings
        self._catalogue = catalogue
        self._checker = checker
        self._bell = bell

    def require_room(self) -> None:
        """Refuse new work when the disk is nearly full, so that running jobs can end."""
        if self._settings.room() <= self._settings.reserve:
            detail = "The disk of the service is full but for a reserve; nothing was recorded."
            raise RequestRefused(kinds.DISK_FULL, detail, headers={"Retry-After": "30"})

    def submit(self, body: bytes, repeatable: Repeatable, caller: Caller) -> Submitted:
        """Queue the job of a document, or find the one that computes the same."""
        with repeatable.in_flight():
            found = self._checker.check(CheckJob(repeatable.sent_key), body)
            own = replace(found.job, owner=caller.owner)
            quota = quota_of(caller, self._settings)
            submitted = self._catalogue.submit(own, found.key, reuse=found.reuse, quota=quota)
        if submitted.created:
            self._wake(len(own.blocks))
        return submitted

    def submit_batch(self, body: bytes, repeatable: Repeatable, caller: Caller) -> SubmittedBatch:
        """Queue all jobs of a document, or none."""
        with repeatable.in_flight():
            key = repeatable.sent_key or SentKey.made_here(caller.owner)
            what = QueueBatch(key, caller.owner, quota_of(caller, self._settings))
            submitted = self._checker.check(what, body)
        self._wake(len(submitted.jobs))
        return submitted

    def _wake(self, blocks: int) -> None:
        wake_relay(self._settings.redis_url)
        self._bell.ring(blocks)


async def _where_there_is_room(request: Request) -> Queueing:
    queueing: Queueing = request.app.state.queueing
    queueing.require_room()
    return queueing


QueueingDependency = Annotated[Queueing, Depends(_where_there_is_room)]
"""Queues jobs; refused with 507 while the disk is nearly full, before the body is read."""
