"""The catalogue: which jobs there are, who computes them, what became of them.

It is the truth. Celery and Redis only wake workers; wiping them loses nothing.
"""

from collections.abc import Callable, Collection, Iterator, Sequence
from functools import partial

from sqlalchemy import text

from jointplay.storage.catalogue import (
    adoption,
    at_work,
    batches,
    census,
    claims,
    ending,
    fair_queueing,
    holding,
    idempotency,
    inconsistencies,
    installation,
    keys,
    labels,
    listing,
    retries,
    schema,
    solvers,
    stored,
    submission,
    tally,
    upkeep,
    usage,
)
from jointplay.storage.catalogue.connections import Connections, Unit
from jointplay.storage.catalogue.errors import (
    SILENT,
    Broken,
    CatalogueError,
    Interrupted,
    Unavailable,
    WrongRevision,
)
from jointplay.storage.catalogue.group_commit import GroupCommit
from jointplay.storage.catalogue.identifiers import Identifiers
from jointplay.storage.catalogue.quotas import NO_QUOTA, Quota, use_of
from jointplay.storage.catalogue.records import (
    BlockEnd,
    Job,
    JobState,
    NewJob,
    SubmissionKey,
    Submitted,
    SubmittedBatch,
)
from jointplay.storage.catalogue.units import (
    claiming,
    durably,
    durably_once,
    reading,
    writing,
    writing_once,
)


class Catalogue:
    """One process's access to the catalogue; safe to share between threads, not across a fork.

    Each method is one unit of reading or writing and is committed when it returns; most are
    functions of this package with the unit as their first argument. Times are epoch seconds (UTC).
    Every method raises `Unavailable` when the database cannot do it at the moment.

    Parameters
    ----------
    url
        SQLAlchemy URL, `sqlite:///file` or `postgresql://user@host/database`.
    clock
        Returns the present time; by default the database's, which all processes have.
    """

    def __init__(self, url: str, *, clock: Callable[[], float] | None = None) -> None:
        self.connections = Connections(url)
        self.clock = clock or self.connections.now
        self._identifiers = Identifiers()
        self._submissions = GroupCommit(self._submit, common=Unavailable)

    def migrate(self) -> None:
        """Create the tables or bring them up to date; several processes may do it at once.

        Tables of a newer program are left as they are: as long as migrations only add to them,
        processes of both can run while one replaces the other.
        """
        self.connections.make_database()
        if self.is_migrated():
            return
        with self.connections.migrating() as connection:
            schema.upgrade(connection)

    def close(self) -> None:
        """Close every connection."""
        self.connections.close()

    def ping(self) -> None:
        """Raise if the database does not answer, or its schema is not one of this program."""
        found = self.connections.repeated(self._named_revision)
        if not schema.serves(found):
            raise WrongRevision(
                f"the catalogue is at revision {found}, this program needs {schema.REVISION}"
            )

    def is_migrated(self) -> bool:
        """Tell whether the database has all tables of this program."""
        return schema.serves(self.connections.repeated(self._revision))

    def _revision(self) -> str | None:
        with self.connections.reading() as connection:
            return schema.present_revision(connection)

    def _named_revision(self) -> str | None:
        with self.connections.reading() as connection:
            named = text("SELECT version_num FROM alembic_version")
            return connection.execute(named).scalar_one_or_none()

    def flaws(self) -> tuple[str, ...]:
        """Return sentences on why nothing else can be asked of the database; none if it is sound.

        Reads all of it. They are for administrators: of a database that cannot be reached they
        have the address, and why not.
        """
        try:
            with self.connections.reading() as connection:
                return schema.flaws(connection)
        except (Broken, Interrupted) as error:
            what = "cannot be read" if isinstance(error, Broken) else SILENT
            return (": ".join((what, *getattr(error, "__notes__", ()))),)

    # What users ask for

    def submit(
        self,
        new: NewJob,
        key: SubmissionKey | None = None,
        *,
        reuse: bool = False,
        quota: Quota = NO_QUOTA,
    ) -> Submitted:
        """Accept a job; it survives a power cut once this returns.

        With a key that was used before the earlier job is returned, and `created` is false. With
        `reuse` so is a job that asks the same of the same solver and is queued, running or
        succeeded, and not expired; then `cached` is true.

        Raises
        ------
        KeyReused
            The key was used before with another fingerprint.
        QuotaExceeded
            Its owner has as much as one may have.
        """
        answer = self._submissions.done(submission.Request(new, key, reuse, quota))
        if isinstance(answer, CatalogueError):
            raise answer
        return answer

    def _submit(self, requests: Sequence[submission.Request]) -> list[Submitted | CatalogueError]:
        return self.connections.repeated(lambda: self._submit_once(requests))

    def _submit_once(
        self, requests: Sequence[submission.Request]
    ) -> list[Submitted | CatalogueError]:
        now = self.clock()
        with self.connections.writing(durable=True) as connection:
            unit = Unit(connection, now)
            next_id = partial(self._identifiers.next, now)
            return submission.submit(unit, requests, next_id, self.clock)

    def submit_batch(
        self,
        jobs: Collection[NewJob],
        *,
        label: str | None = None,
        key: SubmissionKey | None = None,
        owner: str = "",
        quota: Quota = NO_QUOTA,
    ) -> SubmittedBatch:
        """Accept many jobs or none; they survive a power cut once this returns.

        Jobs get the batch's id. With a key that was used before the earlier batch is returned,
        and `created` is false.

        Raises
        ------
        ValueError
            There is no job, or there are more than 10 000.
        KeyReused
            The key was used before with another fingerprint.
        QuotaExceeded
            Its owner would have more than one may have.
        RetriedMeanwhile
            A job that one of them repeats was retried before.
        """
        if not 1 <= len(jobs) <= batches.LARGEST_BATCH:
            raise ValueError(f"a batch has 1 to {batches.LARGEST_BATCH} jobs, not {len(jobs)}")

        def submit() -> SubmittedBatch:
            now = self.clock()
            identifier, *members = [self._identifiers.next(now) for _ in range(len(jobs) + 1)]
            with self.connections.writing(durable=True) as connection:
                unit = Unit(connection, now)
                return batches.submit_batch(
                    unit, identifier, members, jobs, label, key, owner, quota
                )

        return self.connections.repeated(submit)

    get = reading(labels.labelled_job)
    batch = reading(batches.find_batch)
    page_of_batches = reading(batches.page_of_batches)
    jobs = reading(listing.page_of_jobs)
    blocks = reading(listing.blocks_of)
    attempts = reading(listing.attempts_of)
    events = reading(listing.events_of)
    statuses = reading(listing.statuses_of)
    identical = reading(submission.same_job)
    request_cancel = durably(submission.request_cancel)
    cancel_batch = durably(batches.cancel_batch)
    delete_batch = durably(batches.delete_batch)
    submitted_job = reading(idempotency.job_submitted_by)
    submitted_batch = reading(batches.submitted_by)
    unsuccessful = reading(retries.unsuccessful)
    delete = durably(upkeep.expire)
    mark_damaged = writing(upkeep.mark_damaged)
    mark_not_reproduced = durably(upkeep.mark_not_reproduced)
    use_of = reading(use_of)

    def every_job(self) -> Iterator[Job]:
        """Yield all jobs that have not expired, newest first."""
        after: str | None = None
        while True:
            page = self.jobs(limit=listing.LARGEST_PAGE, after=after)
            yield from page.jobs
            if page.next is None:
                return
            after = page.next

    def expired(self, job: Job) -> bool:
        """Tell whether a job and its results can be read no more."""
        return job.expired(self.clock())

    # Who may ask for it

    key = reading(keys.find_key)
    make_key = durably(keys.make_key)
    revoke_key = durably(keys.revoke_key)
    note_use_of_key = writing(keys.note_use)
    all_keys = reading(keys.all_keys)

    # What workers do

    claim_block = claiming(claims.claim)
    claim_next = claiming(claims.claim_next)
    # by workers elsewhere, which go on where a power cut ends whoever keeps a catalogue in a file:
    # claims that were forgotten would give another worker the number of their attempt
    claim_block_elsewhere = durably_once(claims.claim)
    claim_next_elsewhere = durably_once(claims.claim_next)
    wake_again = writing(solvers.wake_again)
    held_by = reading(listing.held_by)
    queued_of = reading(listing.queued_of)
    note_worker = writing(solvers.note_worker)
    note_spent = writing_once(tally.note_spent)
    held = reading(holding.held)
    verdict = reading(holding.verdict)
    heartbeat = writing(holding.heartbeat)
    record_progress = writing(holding.record_progress)
    note_activity = writing(holding.note_activity)
    record_checkpoint = writing(holding.record_checkpoint)
    release = writing(ending.release)
    put_off = writing(ending.put_off)
    refuse = durably(ending.refuse)
    note_cut_off = writing(ending.note_cut_off)

    _finish = writing(ending.finish)
    _finish_durably = durably(ending.finish)

    def finish(self, block_id: str, attempt: int, end: BlockEnd, /) -> JobState:
        """Do as `ending.finish`; the end survives a power cut, unless it is repeatable."""
        finish = self._finish if end.repeatable else self._finish_durably
        return finish(block_id, attempt, end)

    mark_of = reading(installation.mark_of)
    note_mark = durably(installation.note_mark)

    # What relay and reaper do, and whoever reconciles the catalogue with the rest

    due_wake_ups = reading(upkeep.due_wake_ups)
    on_the_way = reading(upkeep.on_the_way)
    mark_published = writing(upkeep.mark_published)
    holders = reading(upkeep.holders)
    reap = durably(upkeep.reap)
    settle = writing(fair_queueing.settle)
    removable = reading(upkeep.removable)
    give_up = writing(upkeep.give_up)
    mark_removed = writing(upkeep.mark_removed)
    unmeasured = reading(stored.unmeasured)
    note_stored = writing(stored.note_stored)
    mend_after_setting_back = writing(upkeep.mend_after_setting_back)
    pass_over = writing_once(usage.pass_over)
    announce_again = writing(upkeep.announce_again)
    inconsistent = reading(inconsistencies.find)
    reconcile = writing(inconsistencies.mend)
    adopt = durably(adoption.adopt)
    newest_event = reading(listing.newest_event)
    known_blocks = reading(listing.known_blocks)
    census = reading(census.census)
    leader = reading(upkeep.leader)
    take_lead = writing(upkeep.take_lead)
    workers = reading(solvers.workers)
    workers_at_work = reading(at_work.workers_at_work)
    devices = reading(at_work.devices)
    forget_workers = writing(solvers.forget_workers)
    unserved = reading(solvers.unserved)
    note_unserved = writing(solvers.note_unserved)
    release_lead = writing(upkeep.release_lead)
