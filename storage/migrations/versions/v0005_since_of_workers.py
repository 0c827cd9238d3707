"""Since when each worker is there."""

import sqlalchemy as sa
from alembic import op

revision = "0005"
down_revision = "0004"


def upgrade() -> None:
    """Add the column; of workers that are there already it is not known."""
    op.add_column("worker", sa.Column("since", sa.Float(53)))
