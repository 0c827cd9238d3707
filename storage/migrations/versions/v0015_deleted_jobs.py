"""When jobs were deleted, whatever the clock says later; see `storage.catalogue.upkeep.expire`."""

import sqlalchemy as sa
from alembic import op

from jointplay.storage.catalogue import functions

revision = "0015"
down_revision = "0014"


def upgrade() -> None:
    """Add the column and its index; jobs that were deleted before have expired."""
    op.add_column("job", sa.Column("deleted", sa.Float(53)))
    there = sa.text("deleted IS NOT NULL AND removed IS NULL")
    op.create_index("ix_job_to_remove", "job", ["id"], sqlite_where=there, postgresql_where=there)
    functions.make(op.get_bind())
