"""The catalogue: which jobs there are, who computes them, what became of them.

It is the truth. Celery and Redis only wake workers; wiping them loses nothing.
"""

import time
from collections.abc import Callable, Sequence
from typing import Any

from sqlalchemy import text
from sqlalchemy.exc import OperationalError

from jointplay.records.job import JobError
from jointplay.storage.catalogue import (
    batches,
    holding,
    listing,
    removal,
    schema,
    submission,
    upkeep,
)
from jointplay.storage.catalogue.connections import Connections
from jointplay.storage.catalogue.errors import KeyReused
from jointplay.storage.catalogue.group_commit import Together
from jointplay.storage.catalogue.identifiers import Identifiers
from jointplay.storage.catalogue.records import (
    Attempt,
    Batch,
    Block,
    BlockState,
    Claim,
    Event,
    Glance,
    Job,
    JobFilter,
    JobPage,
    JobState,
    NewJob,
    Reaped,
    SubmissionKey,
    Submitted,
    SubmittedBatch,
    Verdict,
    WakeUp,
)
from jointplay.storage.catalogue.rows import find_job


class Catalogue:
    """One process's access to the catalogue; safe to share between threads, not across a fork.

    Each method is one unit of reading or writing and is committed when it returns. Times are
    epoch seconds (UTC).

    Parameters
    ----------
    url
        SQLAlchemy URL, `sqlite:///file` or `postgresql+…`.
    clock
        Returns the present time.
    """

    def __init__(self, url: str, *, clock: Callable[[], float] = time.time) -> None:
        self._connections = Connections(url)
        self._clock = clock
        self._identifiers = Identifiers()
        self._submissions = Together(self._submit, common=OperationalError)

    def migrate(self) -> None:
        """Create the tables or bring them up to date; several processes may do it at once."""
        with self._connections.reading() as connection:
            if schema.present_revision(connection) == schema.REVISION:
                return
        with self._connections.migrating() as connection:
            schema.upgrade(connection)

    def close(self) -> None:
        """Close every connection."""
        self._connections.close()

    def ping(self) -> None:
        """Raise if the database does not answer or its schema is not the present one."""
        with self._connections.reading() as connection:
            found = connection.execute(text("SELECT version_num FROM alembic_version")).scalar()
        if found != schema.REVISION:
            raise RuntimeError(
                f"the catalogue is at revision {found}, this program needs {schema.REVISION}"
            )

    # What users ask for

    def submit(
        self, new: NewJob, key: SubmissionKey | None = None, *, reuse: bool = False
    ) -> Submitted:
        """Accept a job; it survives a power cut once this returns.

        With a key that was used before the earlier job is returned, and `created` is false. With
        `reuse` so is a job of the same owner that asks the same of the same solver and is queued,
        running or succeeded, and not expired; then `cached` is true.

        Raises
        ------
        KeyReused
            The key was used before with another fingerprint.
        """
        answer = self._submissions.done(submission.Request(new, key, reuse))
        if isinstance(answer, KeyReused):
            raise answer
        return answer

    def _submit(self, requests: Sequence[submission.Request]) -> list[Submitted | KeyReused]:
        now = self._clock()
        with self._connections.writing(durable=True) as connection:
            return submission.submit(connection, requests, lambda: self._identifiers.next(now), now)

    def request_cancel(self, job: str) -> Job:
        """Cancel a queued job at once, ask a running one to stop, leave a finished one alone.

        Raises
        ------
        JobNotFound
        """
        with self._connections.writing(durable=True) as connection:
            return submission.request_cancel(connection, job, self._clock())

    def submit_batch(
        self,
        jobs: Sequence[NewJob],
        *,
        owner: str = "",
        label: str | None = None,
        key: SubmissionKey | None = None,
    ) -> SubmittedBatch:
        """Accept many jobs or none; they survive a power cut once this returns.

        Jobs get this owner and the batch's id. With a key that was used before the earlier batch
        is returned, and `created` is false.

        Raises
        ------
        ValueError
            There is no job, or there are more than 10 000.
        KeyReused
            The key was used before with another fingerprint.
        """
        if not 1 <= len(jobs) <= batches.LARGEST_BATCH:
            raise ValueError(f"a batch has 1 to {batches.LARGEST_BATCH} jobs, not {len(jobs)}")
        now = self._clock()
        identifier, *members = [self._identifiers.next(now) for _ in range(len(jobs) + 1)]
        with self._connections.writing(durable=True) as connection:
            return batches.submit_batch(
                connection, identifier, members, jobs, owner, label, key, now
            )

    def batch(self, batch: str) -> Batch:
        """Return a batch and how far the whole of it is; its jobs are listed by `jobs`.

        Raises
        ------
        BatchNotFound
        """
        with self._connections.reading() as connection:
            return batches.find_batch(connection, batch)

    def cancel_batch(self, batch: str) -> Batch:
        """Cancel every job of a batch that has not ended, as `request_cancel` does.

        Raises
        ------
        BatchNotFound
        """
        with self._connections.writing(durable=True) as connection:
            return batches.cancel_batch(connection, batch, self._clock())

    def get(self, job: str) -> Job:
        """Return a job.

        Raises
        ------
        JobNotFound
        """
        with self._connections.reading() as connection:
            return find_job(connection, job)

    def jobs(
        self,
        *,
        limit: int = 50,
        after: str | None = None,
        oldest_first: bool = False,
        **wanted: Any,
    ) -> JobPage:
        """Return one page of jobs, newest first; `after` is the `next` of the page before.

        `oldest_first` turns it round: the jobs of a batch then come as they were submitted. The
        other arguments are fields of `JobFilter`. Expired jobs are left out.

        Raises
        ------
        ValueError
            The limit is not between 1 and 1000.
        """
        with self._connections.reading() as connection:
            return listing.page_of_jobs(
                connection,
                JobFilter(**wanted),
                self._clock(),
                limit=limit,
                after=after,
                oldest_first=oldest_first,
            )

    def blocks(self, job: str) -> tuple[Block, ...]:
        """Return a job's blocks by index."""
        with self._connections.reading() as connection:
            return listing.blocks_of(connection, job)

    def attempts(self, job: str) -> tuple[Attempt, ...]:
        """Return every attempt at a job's blocks."""
        with self._connections.reading() as connection:
            return listing.attempts_of(connection, job)

    def events(self, job: str, *, after: int = 0, limit: int = 1000) -> tuple[Event, ...]:
        """Return what happened to a job after event number `after`, in order."""
        with self._connections.reading() as connection:
            return listing.events_of(connection, job, after=after, limit=limit)

    def glances(self, jobs: Sequence[str]) -> tuple[Glance, ...]:
        """Return what changes while jobs are computed, of those among them that there are."""
        with self._connections.reading() as connection:
            return listing.glances_of(connection, jobs)

    def identical(self, new: NewJob) -> str | None:
        """Return the id of the job that `submit` would find instead of making this one."""
        with self._connections.reading() as connection:
            return submission.same_job(connection, new, self._clock())

    def expired(self, job: Job) -> bool:
        """Tell whether a job and its results can be read no more."""
        return job.expired(self._clock())

    def delete(self, job: str) -> Job:
        """Let a finished job expire now; its results are removed soon.

        Raises
        ------
        JobNotFound
        JobNotFinished
            It has to be cancelled first.
        """
        with self._connections.writing(durable=True) as connection:
            return removal.expire(connection, job, self._clock())

    # What workers do

    def claim_block(self, block: str, worker: str, lease: float) -> Claim | None:
        """Take a queued block for `lease` seconds; none if there is nothing (left) to do."""
        with self._connections.writing() as connection:
            return holding.claim(connection, block, worker, lease, self._clock())

    def verdict(self, block: str, attempt: int) -> Verdict:
        """Return whether to go on, reading only; Fenced if the block is held no more."""
        with self._connections.reading() as connection:
            return holding.verdict(connection, block, attempt)

    def heartbeat(self, block: str, attempt: int, lease: float) -> Verdict:
        """Hold a block `lease` seconds longer; Fenced if it is held no more."""
        with self._connections.writing() as connection:
            return holding.heartbeat(connection, block, attempt, lease, self._clock())

    def record_progress(
        self,
        block: str,
        attempt: int,
        lease: float,
        *,
        time: float,
        fraction: float,
        steps: int | None = None,
    ) -> Verdict:
        """Heartbeat that also stores simulated time [s], fraction (0..1) and steps; or Fenced."""
        now = self._clock()
        with self._connections.writing() as connection:
            return holding.record_progress(
                connection, block, attempt, lease, now, time=time, fraction=fraction, steps=steps
            )

    def note_activity(self, block: str, attempt: int, activity: str) -> None:
        """Show a word for what the job is busy with until it advances; or Fenced.

        It is recorded as an event, too. For what takes long and has no progress: compiling.
        """
        with self._connections.writing() as connection:
            holding.note_activity(connection, block, attempt, activity, self._clock())

    def record_checkpoint(
        self, block: str, attempt: int, *, watermark: int, checkpoint: str
    ) -> None:
        """Store a checkpoint that is durable on disk; Fenced if the block is held no more."""
        with self._connections.writing() as connection:
            holding.record_checkpoint(
                connection, block, attempt, watermark=watermark, checkpoint=checkpoint
            )

    def finish(
        self,
        block: str,
        attempt: int,
        outcome: BlockState,
        error: JobError | None = None,
        *,
        time: float | None = None,
        fraction: float | None = None,
        steps: int | None = None,
        durable: bool = True,
    ) -> JobState:
        """End a held block (done, failed with an error, cancelled); return the job's state.

        `time` [s], `fraction` (0..1) and `steps` say how far it came, if that is known. If not
        `durable` a power cut may undo it: the block is then taken again.

        Raises
        ------
        Fenced
            The block is held no more; nothing was changed.
        """
        with self._connections.writing(durable=durable) as connection:
            return holding.finish(
                connection,
                block,
                attempt,
                outcome,
                error,
                self._clock(),
                time=time,
                fraction=fraction,
                steps=steps,
            )

    def release(self, block: str, attempt: int) -> None:
        """Give a held block back unfinished, to be resumed; Fenced if it is held no more."""
        with self._connections.writing() as connection:
            holding.release(connection, block, attempt, self._clock())

    # What relay and reaper do

    def due_wake_ups(self, outstanding: int) -> tuple[WakeUp, ...]:
        """Return the wake-ups to publish now; at most `outstanding` are then on their way."""
        with self._connections.reading() as connection:
            return upkeep.due_wake_ups(connection, outstanding, self._clock())

    def mark_published(self, blocks: tuple[str, ...], republish_after: float) -> None:
        """Remember that workers were told of these blocks."""
        with self._connections.writing() as connection:
            upkeep.mark_published(connection, blocks, republish_after, self._clock())

    def reap(self, max_attempts: int) -> Reaped:
        """Take blocks from workers whose lease ran out; fail what lost too many workers."""
        with self._connections.writing(durable=True) as connection:
            return upkeep.reap(connection, max_attempts, self._clock())

    def removable(self, limit: int) -> tuple[str, ...]:
        """Return jobs that have expired and whose results are still there."""
        with self._connections.reading() as connection:
            return removal.removable(connection, limit, self._clock())

    def mark_removed(self, jobs: Sequence[str]) -> None:
        """Remember that the results of these jobs are gone."""
        with self._connections.writing() as connection:
            removal.mark_removed(connection, jobs, self._clock())

    def hold_duty(self, name: str, holder: str, seconds: float) -> bool:
        """Take or keep a duty for so many seconds; false while somebody else has it."""
        with self._connections.writing() as connection:
            return upkeep.hold_duty(connection, name, holder, seconds, self._clock())

    def lay_down_duty(self, name: str, holder: str) -> None:
        """Give a duty up at once."""
        with self._connections.writing() as connection:
            upkeep.lay_down_duty(connection, name, holder, self._clock())
