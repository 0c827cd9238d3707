"""Functions of PostgreSQL, for what workers ask most often; see `storage.catalogue.functions`."""

from alembic import op

from jointplay.storage.catalogue import functions

revision = "0002"
down_revision = "0001"


def upgrade() -> None:
    """Make them."""
    functions.make(op.get_bind())
