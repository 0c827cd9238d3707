"""Files as a power cut leaves them: nothing is there that was not synced.

What was written over bytes that had been synced stays, as do names of files.
"""

import os
import struct
from pathlib import Path
from typing import Final

from jointplay.chaos.inside import COMMITTED, INDEX, INDEX_SIZE, SYNCED

_FRAMES, _SALT = 16, slice(32, 40)  # of the index: the last frame's number, the log's generation
_ATTEMPTED = 128  # frames that a checkpoint may have put into the database, for which it synced all
_LOG_HEADER, _FRAME_HEADER = 32, 24
_LOG_PAGE, _LOG_SALT = 8, slice(16, 24)
_CATALOGUE: Final = Path("data", "catalogue.sqlite-wal")


def cut_results(folder: Path) -> None:
    """Cut the files of results of an installation that was killed to what was synced of them."""
    lines = (folder / SYNCED).read_text().split("\n")
    synced = {int(inode): int(size) for inode, size in (line.split() for line in lines if line)}
    for name in ("running", "results"):
        for path in (folder / "data" / name).rglob("*"):
            if path.is_file():
                status = path.stat()
                os.truncate(path, min(synced.get(status.st_ino, 0), status.st_size))


def cut_catalogue(folder: Path) -> None:
    """Take the transactions that were not synced from the catalogue of such an installation.

    Its write-ahead log is cut behind the last frame that was synced, by the format on
    https://www.sqlite.org/walformat.html; nobody may have the catalogue open.
    """
    log, index = folder / _CATALOGUE, folder / INDEX
    if not log.exists() or log.stat().st_size < _LOG_HEADER:
        return
    with log.open("rb") as file:
        header = file.read(_LOG_HEADER)
    state, generation = index.read_bytes(), header[_LOG_SALT]
    if state[_SALT] != generation:  # all of this log is in the database: the next one is begun
        return
    notes = (folder / COMMITTED).read_bytes()
    whole = range(0, len(notes) - INDEX_SIZE + 1, INDEX_SIZE)
    commits = [notes[first : first + INDEX_SIZE] for first in whole]
    frames: list[int] = [_number(one, _FRAMES) for one in commits if one[_SALT] == generation]
    kept = max([*frames, _number(state, _ATTEMPTED)])
    page: int = struct.unpack_from(">I", header, _LOG_PAGE)[0]
    end = _LOG_HEADER + kept * (_FRAME_HEADER + page)
    os.truncate(log, min(end, log.stat().st_size))
    index.unlink()


def _number(index: bytes, offset: int) -> int:
    number: int = struct.unpack_from("=I", index, offset)[0]
    return number
