"""Batches of jobs; what a job is busy with; indexes for many blocks and jobs at once."""

import sqlalchemy as sa
from alembic import op

revision = "0002"
down_revision = "0001"


def upgrade() -> None:
    """Add the table batch, a column to job, and three indexes."""
    op.create_table(
        "batch",
        sa.Column("id", sa.String(26), nullable=False),
        sa.Column("owner", sa.String(64), nullable=False),
        sa.Column("label", sa.Text),
        sa.Column("created", sa.Float(53), nullable=False),
        sa.Column("count", sa.Integer, nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_batch"),
    )
    op.add_column("job", sa.Column("activity", sa.String(32)))
    op.create_index("ix_job_batch_state", "job", ["batch", "state", "progress_fraction"])
    op.create_index("ix_outbox_queue_due", "outbox", ["queue", "due", "block"])
