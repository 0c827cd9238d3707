"""For how long a job was asked to be kept, however late it ends or is found; see `Job.lifetime`."""

import sqlalchemy as sa
from alembic import op

from jointplay.storage.catalogue import functions

revision = "0016"
down_revision = "0015"


def upgrade() -> None:
    """Add the column; of jobs before it, only their expiry is known."""
    op.add_column("job", sa.Column("kept_for", sa.Float(53)))
    functions.make(op.get_bind())
