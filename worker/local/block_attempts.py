"""Attempts at the blocks of a study in a store that was begun."""

from pathlib import Path
from typing import NamedTuple


class BlockAttempt(NamedTuple):
    """An attempt at a block to come: its number, and the restart point that it goes on from."""

    number: int = 1
    resume_from: str | None = None


def block_attempts(folder: Path) -> dict[int, BlockAttempt]:
    """Return the next attempt at every block of a store that was begun, by its index."""
    from jointplay.storage.packed import Running
    from jointplay.storage.studies.part import attempt_of, newest

    return {
        index: BlockAttempt((attempt_of(name) or 0) + 1, name)
        for index, name in newest(Running(folder).parts()).items()
    }
