"""The data that belong to the catalogue; see `storage.installation`."""

import sqlalchemy as sa
from alembic import op

revision = "0013"
down_revision = "0012"


def upgrade() -> None:
    """Add the table; the next service to start says which data they are."""
    op.create_table(
        "installation",
        sa.Column("place", sa.String(16), nullable=False),
        sa.Column("mark", sa.String(64), nullable=False),
        sa.PrimaryKeyConstraint("place", name="pk_installation"),
    )
