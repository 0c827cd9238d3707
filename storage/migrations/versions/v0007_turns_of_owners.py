"""Turns of owners: whose block is claimed next."""

import sqlalchemy as sa
from alembic import op

from jointplay.storage.catalogue import functions

revision = "0007"
down_revision = "0006"


def upgrade() -> None:
    """Add the table and the columns; what waits already comes first, in its order."""
    op.add_column("outbox", sa.Column("owner", sa.String(64), nullable=False, server_default=""))
    op.add_column("outbox", sa.Column("turn", sa.BigInteger, nullable=False, server_default="0"))
    op.create_index("ix_outbox_queue_turn", "outbox", ["queue", "turn", "block", "owner", "due"])
    op.drop_index("ix_outbox_queue_due", "outbox")
    op.create_table(
        "turn",
        sa.Column("queue", sa.String(32), nullable=False),
        sa.Column("owner", sa.String(64), nullable=False),
        sa.Column("next", sa.BigInteger, nullable=False),
        sa.PrimaryKeyConstraint("queue", "owner", name="pk_turn"),
    )
    op.execute(
        "UPDATE outbox SET owner = (SELECT job.owner FROM block JOIN job ON job.id = block.job"
        " WHERE block.id = outbox.block)"
    )
    functions.make(op.get_bind())
