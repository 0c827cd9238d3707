"""Shares of owners in the workers' time, instead of turns block by block.

The table `turn` and the column `outbox.turn` stay for programs before this one, whose blocks come
as if they had been submitted by this one.
"""

import sqlalchemy as sa
from alembic import op

from jointplay.storage.catalogue import functions

revision = "0009"
down_revision = "0008"


def upgrade() -> None:
    """Add the table and the columns; owners with work waiting begin alike."""
    op.create_table(
        "share",
        sa.Column("queue", sa.String(32), nullable=False),
        sa.Column("owner", sa.String(64), nullable=False),
        sa.Column("began", sa.Float(53), nullable=False),
        sa.Column("next", sa.Float(53), nullable=False),
        sa.Column("cost", sa.Float(53), nullable=False, server_default="1"),
        sa.PrimaryKeyConstraint("queue", "owner", name="pk_share"),
    )
    op.add_column("attempt", sa.Column("account", sa.String(32)))
    op.add_column("attempt", sa.Column("charged", sa.Float(53)))
    unsettled = sa.text("account IS NOT NULL")
    op.create_index(
        "ix_attempt_unsettled",
        "attempt",
        ["account"],
        sqlite_where=unsettled,
        postgresql_where=unsettled,
    )
    op.create_index("ix_outbox_queue_owner", "outbox", ["queue", "owner", "block", "due"])
    op.drop_index("ix_outbox_queue_turn", "outbox")
    functions.make(op.get_bind())
