"""Queueing: what a request asks for is checked and stored, and those who compute it are woken."""

import json
from dataclasses import replace
from typing import Annotated

from fastapi import Depends, Request

from jointplay.service.access import Caller
from jointplay.service.access.quotas import quota_of
from jointplay.service.batches.admission import QueueBatch
from jointplay.service.checking import Checker, CheckJob, RepeatJob
from jointplay.service.idempotency import Repeatable, SentKey
from jointplay.service.jobs.submission import kept_like
from jointplay.service.problems import RequestRefused, kinds
from jointplay.service.workers.new_blocks import NewBlocks
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import Batch, Job, Submitted, SubmittedBatch
from jointplay.storage.catalogue.retries import RETRIABLE
from jointplay.storage.settings import Settings
from jointplay.worker.wake_up import wake_relay


class Queueing:
    """Queues what callers submit; the application has one."""

    def __init__(
        self, settings: Settings, catalogue: Catalogue, checker: Checker, new_blocks: NewBlocks
    ) -> None:
        self._settings = settings
        self._catalogue = catalogue
        self._checker = checker
        self._new_blocks = new_blocks

    def require_room(self) -> None:
        """Refuse new work when the disk is nearly full, so that running jobs can end."""
        if self._settings.room() <= self._settings.reserve:
            detail = "The disk of the service is full but for a reserve; nothing was recorded."
            raise RequestRefused(kinds.DISK_FULL, detail, headers={"Retry-After": "30"})

    def submit(self, body: bytes, repeatable: Repeatable, caller: Caller) -> Submitted:
        """Queue the job of a document, or find the one that computes the same."""
        with repeatable.in_flight():
            sent = repeatable.sent_key
            key = None if sent is None else sent.with_body(body)
            earlier = None if key is None else self._catalogue.submitted_job(key)
            if earlier is not None:  # to find it takes milliseconds, a check may not
                return earlier
            found = self._checker.check(CheckJob(), body)
            own = replace(found.job, owner=caller.owner)
            quota = quota_of(caller, self._settings)
            if key is None and not found.reuse:  # what finds it if the answer to a commit is lost
                key = SentKey.made_here(caller.owner).with_body()
            submitted = self._catalogue.submit(own, key, reuse=found.reuse, quota=quota)
        if submitted.created:
            self._wake(len(own.blocks))
        return submitted

    def submit_batch(self, body: bytes, repeatable: Repeatable, caller: Caller) -> SubmittedBatch:
        """Queue all jobs of a document, or none; or find the batch of an earlier request."""
        with repeatable.in_flight():
            key = (repeatable.sent_key or SentKey.made_here(caller.owner)).with_body(body)
            submitted = self._catalogue.submitted_batch(key)
            if submitted is None:
                what = QueueBatch(key, caller.owner, quota_of(caller, self._settings))
                submitted = self._checker.check(what, body)
        return self._woken_for(submitted)

    def retry(self, job: Job, repeatable: Repeatable, caller: Caller) -> Submitted:
        """Queue a job's document again as a new job, or find the one that computes the same.

        The job must have failed or been cancelled; the new one belongs to its owner.
        """
        if job.state not in RETRIABLE:
            detail = f"Job {job.id} is {job.state}; what failed or was cancelled can be retried."
            raise RequestRefused(kinds.NOTHING_TO_RETRY, detail)
        sent = repeatable.sent_key
        key = None if sent is None else sent.with_body()
        with repeatable.in_flight():
            found = self._checker.check(RepeatJob(), json.dumps(job.spec).encode())
            kept = kept_like(found, job.lifetime, self._catalogue.clock())
            own = replace(kept, owner=job.owner, retry_of=job.id)
            quota = quota_of(caller, self._settings)
            submitted = self._catalogue.submit(own, key, reuse=True, quota=quota)
        if submitted.created:
            self._wake(len(own.blocks))
        return submitted

    def retry_batch(self, batch: Batch, caller: Caller) -> SubmittedBatch:
        """Queue those jobs of a batch anew that failed or were cancelled, as a batch of their own.

        Those that were retried before are left out; asked again, it finds the batch that it made.
        """
        ended = self._catalogue.unsuccessful(batch.id)
        key = SentKey.of_retry(batch.id, [job.id for job, _ in ended], batch.owner).with_body()
        found = self._catalogue.submitted_batch(key)
        if found is not None:
            return found
        jobs = [job for job, retried in ended if not retried]
        if not jobs:
            gone = sum(batch.states[state] for state in RETRIABLE) > len(ended)
            why = "none failed or was cancelled"
            if ended or gone:
                became = ["were retried before"] * bool(ended) + ["were deleted or expired"] * gone
                why = f"all that failed or were cancelled {', or '.join(became)}"
            detail = f"Batch {batch.id} has no job to retry: {why}."
            raise RequestRefused(kinds.NOTHING_TO_RETRY, detail)
        document = {"jobs": [job.spec for job in jobs], "label": batch.label or ""}
        quota, retries = quota_of(caller, self._settings), tuple(job.id for job in jobs)
        lifetimes = tuple(job.lifetime for job in jobs)
        what = QueueBatch(key, batch.owner, quota, retries, lifetimes)
        return self._woken_for(self._checker.check(what, json.dumps(document).encode()))

    def _woken_for(self, submitted: SubmittedBatch) -> SubmittedBatch:
        if submitted.created:
            self._wake(len(submitted.jobs))
        return submitted

    def _wake(self, blocks: int) -> None:
        wake_relay(self._settings.redis_url)
        self._new_blocks.announce(blocks)


async def _where_there_is_room(request: Request) -> Queueing:
    queueing: Queueing = request.app.state.queueing
    queueing.require_room()
    return queueing


QueueingDependency = Annotated[Queueing, Depends(_where_there_is_room)]
"""Queues jobs; refused with 507 while the disk is nearly full, before the body is read."""
