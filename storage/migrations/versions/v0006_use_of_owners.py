"""Use of what owners may have a limited amount of: bytes of results, processor time."""

import sqlalchemy as sa
from alembic import op

from jointplay.storage.catalogue import functions

revision = "0006"
down_revision = "0005"


def upgrade() -> None:
    """Add the table, the column and its indices; what has ended is measured by the relay."""
    op.add_column("job", sa.Column("stored", sa.BigInteger))
    ended = "finished IS NOT NULL"
    for name, columns, where in (
        ("ix_job_unmeasured", ["id"], f"stored IS NULL AND {ended} AND owner != ''"),
        ("ix_job_owner_stored", ["owner", "stored"], "stored > 0"),
    ):
        there = sa.text(where)
        op.create_index(name, "job", columns, sqlite_where=there, postgresql_where=there)
    op.create_table(
        "usage",
        sa.Column("owner", sa.String(64), nullable=False),
        sa.Column("hour", sa.Integer, nullable=False),
        sa.Column("worker", sa.String(200), nullable=False),
        sa.Column("seconds", sa.Float(53), nullable=False),
        sa.PrimaryKeyConstraint("owner", "hour", "worker", name="pk_usage"),
    )
    op.execute("UPDATE job SET stored = 0 WHERE removed IS NOT NULL")
    functions.make(op.get_bind())
