"""Further labels of jobs; see `storage.catalogue.labels`."""

import sqlalchemy as sa
from alembic import op

revision = "0012"
down_revision = "0011"


def upgrade() -> None:
    """Add the table."""
    op.create_table(
        "label",
        sa.Column("label", sa.Text(), nullable=False),
        sa.Column("job", sa.String(26), nullable=False),
        sa.ForeignKeyConstraint(["job"], ["job.id"], "fk_label_job", ondelete="CASCADE"),
        sa.PrimaryKeyConstraint("label", "job", name="pk_label"),
    )
    op.create_index("ix_label_job", "label", ["job"])
