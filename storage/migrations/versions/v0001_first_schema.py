"""First schema: jobs, blocks, attempts, events, outbox, idempotency keys, duties."""

import sqlalchemy as sa
from alembic import op

revision = "0001"
down_revision = None


def upgrade() -> None:
    """Create every table."""
    op.create_table(
        "job",
        sa.Column("id", sa.String(26), nullable=False),
        sa.Column("kind", sa.String(32), nullable=False),
        sa.Column("owner", sa.String(64), nullable=False),
        sa.Column("label", sa.Text),
        sa.Column("batch", sa.String(26)),
        sa.Column("spec", sa.JSON, nullable=False),
        sa.Column("digest", sa.String(64), nullable=False),
        sa.Column("solver_version", sa.String(64), nullable=False),
        sa.Column("result_schema", sa.Integer, nullable=False),
        sa.Column("state", sa.String(10), nullable=False),
        sa.Column("progress_time", sa.Float(53), nullable=False),
        sa.Column("progress_fraction", sa.Float(53), nullable=False),
        sa.Column("attempt", sa.Integer, nullable=False),
        sa.Column("error", sa.JSON),
        sa.Column("created", sa.Float(53), nullable=False),
        sa.Column("started", sa.Float(53)),
        sa.Column("finished", sa.Float(53)),
        sa.Column("expires", sa.Float(53)),
        sa.PrimaryKeyConstraint("id", name="pk_job"),
    )
    for column in ("state", "owner", "batch", "digest"):
        op.create_index(f"ix_job_{column}_id", "job", [column, "id"])
    op.create_index("ix_job_expires", "job", ["expires"])
    op.create_table(
        "block",
        sa.Column("id", sa.String(40), nullable=False),
        sa.Column("job", sa.String(26), nullable=False),
        sa.Column("index", sa.Integer, nullable=False),
        sa.Column("first", sa.BigInteger, nullable=False),
        sa.Column("count", sa.BigInteger, nullable=False),
        sa.Column("state", sa.String(10), nullable=False),
        sa.Column("attempt", sa.Integer, nullable=False),
        sa.Column("losses", sa.Integer, nullable=False),
        sa.Column("lease_until", sa.Float(53)),
        sa.Column("worker", sa.String(200)),
        sa.Column("watermark", sa.BigInteger, nullable=False),
        sa.Column("checkpoint", sa.Text),
        sa.Column("progress_time", sa.Float(53), nullable=False),
        sa.Column("progress_fraction", sa.Float(53), nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_block"),
        sa.UniqueConstraint("job", "index", name="uq_block_job"),
        sa.ForeignKeyConstraint(["job"], ["job.id"], name="fk_block_job", ondelete="CASCADE"),
    )
    op.create_index("ix_block_state_lease_until", "block", ["state", "lease_until"])
    op.create_table(
        "attempt",
        sa.Column("block", sa.String(40), nullable=False),
        sa.Column("number", sa.Integer, nullable=False),
        sa.Column("worker", sa.String(200), nullable=False),
        sa.Column("started", sa.Float(53), nullable=False),
        sa.Column("ended", sa.Float(53)),
        sa.Column("outcome", sa.String(16)),
        sa.PrimaryKeyConstraint("block", "number", name="pk_attempt"),
        sa.ForeignKeyConstraint(
            ["block"], ["block.id"], name="fk_attempt_block", ondelete="CASCADE"
        ),
    )
    op.create_table(
        "event",
        sa.Column("job", sa.String(26), nullable=False),
        sa.Column("seq", sa.Integer, nullable=False),
        sa.Column("time", sa.Float(53), nullable=False),
        sa.Column("type", sa.String(32), nullable=False),
        sa.Column("data", sa.JSON, nullable=False),
        sa.PrimaryKeyConstraint("job", "seq", name="pk_event"),
        sa.ForeignKeyConstraint(["job"], ["job.id"], name="fk_event_job", ondelete="CASCADE"),
    )
    op.create_table(
        "outbox",
        sa.Column("block", sa.String(40), nullable=False),
        sa.Column("queue", sa.String(32), nullable=False),
        sa.Column("created", sa.Float(53), nullable=False),
        sa.Column("due", sa.Float(53), nullable=False),
        sa.Column("tries", sa.Integer, nullable=False),
        sa.PrimaryKeyConstraint("block", name="pk_outbox"),
        sa.ForeignKeyConstraint(
            ["block"], ["block.id"], name="fk_outbox_block", ondelete="CASCADE"
        ),
    )
    op.create_index("ix_outbox_due", "outbox", ["due"])
    op.create_table(
        "idempotency",
        sa.Column("owner", sa.String(64), nullable=False),
        sa.Column("key", sa.String(255), nullable=False),
        sa.Column("fingerprint", sa.String(64), nullable=False),
        sa.Column("job", sa.String(26)),
        sa.Column("batch", sa.String(26)),
        sa.Column("created", sa.Float(53), nullable=False),
        sa.Column("expires", sa.Float(53), nullable=False),
        sa.PrimaryKeyConstraint("owner", "key", name="pk_idempotency"),
        sa.ForeignKeyConstraint(["job"], ["job.id"], name="fk_idempotency_job", ondelete="CASCADE"),
    )
    op.create_index("ix_idempotency_expires", "idempotency", ["expires"])
    duty = op.create_table(
        "duty",
        sa.Column("name", sa.String(32), nullable=False),
        sa.Column("holder", sa.String(200), nullable=False),
        sa.Column("until", sa.Float(53), nullable=False),
        sa.PrimaryKeyConstraint("name", name="pk_duty"),
    )
    op.bulk_insert(duty, [{"name": "relay", "holder": "", "until": 0.0}])
