"""Units that read, at the same time."""

from contextlib import ExitStack
from pathlib import Path

from sqlalchemy import text

from jointplay.storage.catalogue.connections import Connections


def test_readers_that_take_long_keep_no_other_out(tmp_path: Path) -> None:
    """The 16th, as of a heartbeat, waited for 30 s, and then failed as no fault that passes."""
    connections = Connections(f"sqlite:///{tmp_path / 'jobs.sqlite'}")
    connections.make_database()
    with ExitStack() as held:
        for _ in range(60):
            reader = held.enter_context(connections.reading())
            assert reader.execute(text("SELECT 1")).scalar_one() == 1
    connections.close()
