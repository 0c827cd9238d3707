"""Keys of the service, and whose jobs and batches are."""

import sqlalchemy as sa
from alembic import op

from jointplay.storage.catalogue import functions

revision = "0003"
down_revision = "0002"


def upgrade() -> None:
    """Add the table and the columns; all jobs so far are nobody's."""
    for table in ("job", "batch"):
        owner = sa.Column("owner", sa.String(64), nullable=False, server_default="")
        op.add_column(table, owner)
    op.create_index("ix_job_owner_id", "job", ["owner", "id"])
    op.create_table(
        "api_key",
        sa.Column("id", sa.String(8), nullable=False),
        sa.Column("sha256", sa.String(64), nullable=False),
        sa.Column("owner", sa.String(64), nullable=False),
        sa.Column("scopes", sa.String(200), nullable=False),
        sa.Column("note", sa.String(200), nullable=False),
        sa.Column("created", sa.Float(53), nullable=False),
        sa.Column("expires", sa.Float(53)),
        sa.Column("revoked", sa.Float(53)),
        sa.Column("last_used", sa.Float(53)),
        sa.PrimaryKeyConstraint("id", name="pk_api_key"),
    )
    functions.make(op.get_bind())
