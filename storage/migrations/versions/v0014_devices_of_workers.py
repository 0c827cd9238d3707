"""The device of a worker that has one; see `storage.catalogue.solvers.note_worker`."""

import sqlalchemy as sa
from alembic import op

revision = "0014"
down_revision = "0013"


def upgrade() -> None:
    """Add the columns; a worker fills them in when it is heard of."""
    op.add_column("worker", sa.Column("device", sa.String(64)))
    op.add_column("worker", sa.Column("rate", sa.Float(53)))
    op.add_column("worker", sa.Column("lanes", sa.Integer()))
