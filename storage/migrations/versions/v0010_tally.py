"""Counters of attempts and of what workers spend seconds on; see `storage.catalogue.tally`."""

import sqlalchemy as sa
from alembic import op

from jointplay.storage.catalogue import functions

revision = "0010"
down_revision = "0009"


def upgrade() -> None:
    """Add the table and the index; what ended before is not counted."""
    said = sa.text("activity = 'no worker has its solver'")
    op.create_index("ix_job_unserved", "job", ["id"], sqlite_where=said, postgresql_where=said)
    op.create_table(
        "tally",
        sa.Column("name", sa.String(32), nullable=False),
        sa.Column("worker", sa.String(200), nullable=False),
        sa.Column("value", sa.Float(53), nullable=False),
        sa.PrimaryKeyConstraint("name", "worker", name="pk_tally"),
    )
    functions.make(op.get_bind())
