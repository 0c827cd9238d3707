"""A function of PostgreSQL for the end of a block; see `storage.catalogue.functions`."""

from alembic import op

from jointplay.storage.catalogue import functions

revision = "0008"
down_revision = "0007"


def upgrade() -> None:
    """Make it."""
    functions.make(op.get_bind())
