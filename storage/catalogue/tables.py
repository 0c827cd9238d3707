"""The catalogue's tables, from which a new database is made.

Columns are named as the fields of `storage.catalogue.records` are, and give their types back.
"""

from dataclasses import asdict
from typing import Any, Final

from sqlalchemy import (
    JSON,
    BigInteger,
    Column,
    ColumnElement,
    Dialect,
    Enum,
    Float,
    ForeignKey,
    Index,
    Integer,
    MetaData,
    String,
    Table,
    Text,
    TypeDecorator,
    UniqueConstraint,
    func,
    literal_column,
)

from jointplay.records.job import JobError
from jointplay.storage.catalogue.records import BlockState, JobState


class StoredError(TypeDecorator[JobError]):
    """Error of a job as a JSON document of its fields."""

    impl = JSON(none_as_null=True)
    cache_ok = True

    def process_bind_param(self, value: JobError | None, dialect: Dialect) -> dict[str, Any] | None:
        """Return what is stored."""
        return None if value is None else asdict(value)

    def process_result_value(self, value: Any, dialect: Dialect) -> JobError | None:
        """Return what was given."""
        return None if value is None else JobError(**value)


metadata = MetaData(
    naming_convention={
        "pk": "pk_%(table_name)s",
        "fk": "fk_%(table_name)s_%(column_0_name)s",
        "uq": "uq_%(table_name)s_%(column_0_name)s",
        "ix": "ix_%(table_name)s_%(column_0_name)s",
    }
)

job = Table(
    "job",
    metadata,
    Column("id", String(26), primary_key=True),
    Column("kind", String(32), nullable=False),
    Column("label", Text),
    Column("batch", String(26)),
    Column("spec", JSON, nullable=False),
    Column("digest", String(64), nullable=False),
    Column("solver_version", String(64), nullable=False),
    Column("result_schema", Integer, nullable=False),
    Column("state", Enum(JobState, native_enum=False, length=10), nullable=False),
    Column("progress_time", Float(53), nullable=False),
    Column("progress_fraction", Float(53), nullable=False),
    Column("attempt", Integer, nullable=False),
    Column("error", StoredError),
    Column("created", Float(53), nullable=False),
    Column("started", Float(53)),
    Column("finished", Float(53)),
    Column("expires", Float(53)),
    Column("activity", String(32)),
    Column("scene", String(200)),
    Column("steps", BigInteger),
    Column("removed", Float(53)),
    Column("damaged", Text),
    Column("owner", String(64), nullable=False, server_default=""),
    Column("processor", String(64)),
    Column("stored", BigInteger),
    Column("deleted", Float(53)),
    Column("kept_for", Float(53)),
    # each list filter with the paging key behind it
    Index("ix_job_state_id", "state", "id"),
    Index("ix_job_batch_id", "batch", "id"),
    # progress of a whole batch without a look at its jobs' documents
    Index("ix_job_batch_state", "batch", "state", "progress_fraction"),
    Index("ix_job_digest_id", "digest", "id"),
    Index("ix_job_kind_id", "kind", "id"),
    Index("ix_job_label_id", "label", "id"),
    Index("ix_job_scene_id", "scene", "id"),
    Index("ix_job_owner_id", "owner", "id"),
    # whose results are to be removed, however many were
    Index("ix_job_removed_expires", "removed", "expires"),
)


def unexpired(now: ColumnElement[float] | float) -> ColumnElement[bool]:
    """Whether a job that has ended is there to be read: see `records.Job.expired`."""
    # no IS NULL: SQLite may then go through the index that begins with `removed`
    kept = func.coalesce(job.c.removed, job.c.deleted, 0.0) == 0.0
    return kept & (job.c.expires.is_(None) | (job.c.expires > now))


_ended = job.c.finished.is_not(None)
UNMEASURED: Final = job.c.stored.is_(None) & _ended & (job.c.owner != literal_column("''"))
"""Jobs of owners that have ended, with results of nobody knows how many bytes yet."""
MEASURED: Final = job.c.stored > literal_column("0")
"""Jobs whose results take room."""
Index("ix_job_unmeasured", job.c.id, sqlite_where=UNMEASURED, postgresql_where=UNMEASURED)
Index(
    "ix_job_owner_stored",
    job.c.owner,
    job.c.stored,
    sqlite_where=MEASURED,
    postgresql_where=MEASURED,
)

TO_REMOVE: Final = job.c.deleted.is_not(None) & job.c.removed.is_(None)
"""Jobs that were deleted, with results that are there still."""
Index("ix_job_to_remove", job.c.id, sqlite_where=TO_REMOVE, postgresql_where=TO_REMOVE)

NO_SOLVER: Final = "no worker has its solver"
"""Activity of a job that no worker may take."""
UNSERVED: Final = job.c.activity == literal_column(f"'{NO_SOLVER}'")
Index("ix_job_unserved", job.c.id, sqlite_where=UNSERVED, postgresql_where=UNSERVED)

# Labels beside that of the job's row; see `storage.catalogue.labels`.
label = Table(
    "label",
    metadata,
    Column("label", Text, primary_key=True),
    Column("job", ForeignKey("job.id", ondelete="CASCADE"), primary_key=True),
    Index("ix_label_job", "job"),
)

batch = Table(
    "batch",
    metadata,
    Column("id", String(26), primary_key=True),
    Column("label", Text),
    Column("created", Float(53), nullable=False),
    Column("count", Integer, nullable=False),
    Column("owner", String(64), nullable=False, server_default=""),
)

block = Table(
    "block",
    metadata,
    Column("id", String(40), primary_key=True),
    Column("job", ForeignKey("job.id", ondelete="CASCADE"), nullable=False),
    Column("index", Integer, nullable=False),
    Column("first", BigInteger, nullable=False),
    Column("count", BigInteger, nullable=False),
    Column("state", Enum(BlockState, native_enum=False, length=10), nullable=False),
    Column("attempt", Integer, nullable=False),
    Column("losses", Integer, nullable=False),
    Column("lease_until", Float(53)),
    Column("worker", String(200)),
    Column("watermark", BigInteger, nullable=False),
    Column("checkpoint", Text),
    Column("progress_time", Float(53), nullable=False),
    Column("progress_fraction", Float(53), nullable=False),
    Column("progress_steps", BigInteger),
    UniqueConstraint("job", "index"),
    Index("ix_block_state_lease_until", "state", "lease_until"),
)

attempt = Table(
    "attempt",
    metadata,
    Column("block", ForeignKey("block.id", ondelete="CASCADE"), primary_key=True),
    Column("number", Integer, primary_key=True),
    Column("worker", String(200), nullable=False),
    Column("started", Float(53), nullable=False),
    Column("ended", Float(53)),
    Column("outcome", String(16)),
    # whose share was charged so many seconds, until it is settled; see `fair_queueing`
    Column("account", String(32)),
    Column("charged", Float(53)),
)
UNSETTLED: Final = attempt.c.account.is_not(None)
Index("ix_attempt_unsettled", attempt.c.account, sqlite_where=UNSETTLED, postgresql_where=UNSETTLED)

event = Table(
    "event",
    metadata,
    Column("job", ForeignKey("job.id", ondelete="CASCADE"), primary_key=True),
    Column("seq", Integer, primary_key=True),
    Column("time", Float(53), nullable=False),
    Column("type", String(32), nullable=False),
    Column("data", JSON, nullable=False),
)

# One row for each queued block, until it is claimed: wake-ups that workers still have to get.
outbox = Table(
    "outbox",
    metadata,
    Column("block", ForeignKey("block.id", ondelete="CASCADE"), primary_key=True),
    Column("queue", String(32), nullable=False),
    Column("created", Float(53), nullable=False),
    Column("due", Float(53), nullable=False),
    Column("tries", Integer, nullable=False),
    Column("owner", String(64), nullable=False, server_default=""),
    Column("turn", BigInteger, nullable=False, server_default="0"),  # of programs before 0009
    Index("ix_outbox_due", "due", "tries"),
    # the next block of each owner, however many wait
    Index("ix_outbox_queue_owner", "queue", "owner", "block", "due"),
)

# What each owner has been charged, s; see `storage.catalogue.fair_queueing`.
share = Table(
    "share",
    metadata,
    Column("queue", String(32), primary_key=True),
    Column("owner", String(64), primary_key=True),
    Column("began", Float(53), nullable=False),  # where their last block was claimed
    Column("next", Float(53), nullable=False),  # where their next one will be
    Column("cost", Float(53), nullable=False, server_default="1"),  # of a block, lately
)

# Of programs before revision 0009.
turn = Table(
    "turn",
    metadata,
    Column("queue", String(32), primary_key=True),
    Column("owner", String(64), primary_key=True),
    Column("next", BigInteger, nullable=False),
)

idempotency = Table(
    "idempotency",
    metadata,
    Column("key", String(255), primary_key=True),
    Column("fingerprint", String(64), nullable=False),
    Column("job", ForeignKey("job.id", ondelete="CASCADE")),
    Column("batch", String(26)),
    Column("created", Float(53), nullable=False),
    Column("expires", Float(53), nullable=False),
    Index("ix_idempotency_expires", "expires"),
)

# Who may ask the service what; see `storage.catalogue.keys`.
api_key = Table(
    "api_key",
    metadata,
    Column("id", String(8), primary_key=True),
    Column("sha256", String(64), nullable=False),
    Column("owner", String(64), nullable=False),
    Column("scopes", String(200), nullable=False),
    Column("note", String(200), nullable=False),
    Column("created", Float(53), nullable=False),
    Column("expires", Float(53)),
    Column("revoked", Float(53)),
    Column("last_used", Float(53)),
)

# Core seconds of owners; see `storage.catalogue.usage`.
usage = Table(
    "usage",
    metadata,
    Column("owner", String(64), primary_key=True),
    Column("hour", Integer, primary_key=True),
    Column("worker", String(200), primary_key=True),
    Column("seconds", Float(53), nullable=False),
)

# What has been counted by workers, or of them; see `storage.catalogue.tally`.
tally = Table(
    "tally",
    metadata,
    Column("name", String(32), primary_key=True),
    Column("worker", String(200), primary_key=True),
    Column("value", Float(53), nullable=False),
)

# Processes that take blocks, with what each computes them, and when it was heard of last and first.
worker = Table(
    "worker",
    metadata,
    Column("name", String(200), primary_key=True),
    Column("version", String(64), nullable=False),
    Column("processor", String(64), nullable=False),
    Column("seen", Float(53), nullable=False),
    Column("since", Float(53)),
    Column("device", String(64)),  # the maker's name
    Column("rate", Float(53)),  # accepted steps of the device a second
    Column("lanes", Integer),  # of the device: points that it computes at a time
)

# Which process does what only one should do at a time, and until when.
leader = Table(
    "leader",
    metadata,
    Column("name", String(32), primary_key=True),
    Column("holder", String(200), nullable=False),
    Column("until", Float(53), nullable=False),
)

# Marks of the data folder and the object store of this catalogue; see `storage.installation`.
installation = Table(
    "installation",
    metadata,
    Column("place", String(16), primary_key=True),
    Column("mark", String(64), nullable=False),
)
