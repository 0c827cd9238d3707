"""Which workers there are, and on which class of processors a job is computed."""

import sqlalchemy as sa
from alembic import op

from jointplay.storage.catalogue import functions

revision = "0004"
down_revision = "0003"


def upgrade() -> None:
    """Add the table and the column; jobs that run are claimed next by any class of processors."""
    op.add_column("job", sa.Column("processor", sa.String(64)))
    op.create_table(
        "worker",
        sa.Column("name", sa.String(200), nullable=False),
        sa.Column("version", sa.String(64), nullable=False),
        sa.Column("processor", sa.String(64), nullable=False),
        sa.Column("seen", sa.Float(53), nullable=False),
        sa.PrimaryKeyConstraint("name", name="pk_worker"),
    )
    connection = op.get_bind()
    if connection.dialect.name == "postgresql":  # it asked for no solver
        op.execute("DROP FUNCTION IF EXISTS claim_block(text, text, float8, float8)")
    functions.make(connection)
