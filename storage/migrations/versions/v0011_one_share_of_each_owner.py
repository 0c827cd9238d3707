"""One share of each owner for all queues, which functions of PostgreSQL keep, too.

That of the queue `jobs` goes on as it; what was charged elsewhere stays for programs before this.
"""

from alembic import op

from jointplay.storage.catalogue import functions

revision = "0011"
down_revision = "0010"


def upgrade() -> None:
    """Replace the functions."""
    functions.make(op.get_bind())
