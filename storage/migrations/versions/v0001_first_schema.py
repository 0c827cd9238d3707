"""The first schema that was released: what later revisions change.

A new database is made from `storage.catalogue.tables` and marked with the newest revision.
"""

revision = "0001"
down_revision = None


def upgrade() -> None:
    """Do nothing: no database is older."""
