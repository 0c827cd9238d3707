"""One block of a study on its way to the store.

A file of an array is written once, when nothing in it can change any more: its bytes depend on
the results alone, and a worker that was given up and comes back late writes the same bytes.
"""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Self

import numpy as np

from jointplay.records.names import TIME
from jointplay.records.point import (
    ENDED,
    Failure,
    PointEnd,
    PointStatus,
    SectionRows,
    StudySlice,
    has_ended,
)
from jointplay.records.run import Floats
from jointplay.storage.errors import InvalidAppend, LostObject, ResultsError
from jointplay.storage.packed import Running
from jointplay.storage.packed.running import PARTS
from jointplay.storage.results import shards
from jointplay.storage.studies import part
from jointplay.storage.studies.layout import StudyLayout
from jointplay.storage.studies.part import Part
from jointplay.storage.studies.points import INDICATORS, STATISTICS


class StudyBlock:
    """Takes what a block's computation hands out; memory is bounded by the points in work.

    After an `OSError` (the disk is full, for example) it is of no use any more; what `flush`
    wrote last can be resumed.

    Parameters
    ----------
    folder
        Of the store, which `create` made.
    layout
        Of the study.
    index
        Of the block in the layout.
    attempt
        Which try at the block this is; each has its own restart file.
    """

    def __init__(self, folder: Path, layout: StudyLayout, index: int, attempt: int = 1) -> None:
        self._layout = layout
        self._first, self._count = layout.blocks[index]
        self._attempt = attempt
        self._files = Running(folder, digest=layout.digest)
        self._part = Part.empty(layout, index)

    @classmethod
    def resume(
        cls, folder: Path, layout: StudyLayout, index: int, attempt: int, name: str
    ) -> tuple[Self, bytes]:
        """Go on from what `flush` of an earlier attempt wrote under a name.

        Returns
        -------
        tuple
            The block, and the bytes that were given to `flush`.

        Raises
        ------
        FileNotFoundError, CorruptStore, CheckpointMismatch
            There is nothing to go on from: begin anew.
        """
        block = cls(folder, layout, index, attempt)
        found = Part.read(block._files, name, layout.digest)
        require_chunks(block._files, layout, found)
        for key, rows in found.open.items():
            chunk = block._new_chunk()
            chunk[:, :, : rows.shape[2]] = rows
            found.open[key] = chunk
        carried, found.carried = found.carried, b""
        block._part = found
        return block, carried

    @staticmethod
    def done(folder: Path, layout: StudyLayout, index: int) -> bool:
        """Whether some attempt finished this block; then there is nothing left to compute."""
        try:
            files = Running(folder, digest=layout.digest)
            found = Part.read(files, part.final_name(index), layout.digest)
            require_chunks(files, layout, found)
        except (FileNotFoundError, ResultsError):
            return False
        return True

    @property
    def watermark(self) -> int:
        """Points that have ended."""
        return self._part.ended

    def total(self, statistic: str) -> float:
        """Return the sum of a statistic over the points that have ended; 0 if none has it."""
        known = self._part.numbers.get(f"{STATISTICS}/{statistic}")
        return 0.0 if known is None else float(np.nansum(known))

    def take(self, piece: StudySlice) -> None:
        """Add what became known; chunks that are full go to the disk.

        Raises
        ------
        InvalidAppend
            A point of another block, sections out of turn or too many, or a point that ended
            before.
        """
        touched: set[int] = set()
        for point in piece.started:
            self._part.status[self._row(point)] = PointStatus.running
        for rows in piece.rows:
            touched.add(self._add_rows(rows))
        for end in piece.ended:
            touched.add(self._add_end(end))
        for row in sorted(touched):
            self._write_full_chunks(row)

    def flush(self, carried: bytes) -> str:
        """Bring everything taken so far to the disk, with what continues the computation.

        Returns
        -------
        str
            The name for `resume`; it stays valid, also while later calls replace the file.
        """
        name = part.name_of(self._part.index, self._attempt)
        self._write_part(name, self._trimmed(), carried)
        return name

    def finish(self) -> None:
        """Write what is left of a block whose points have all ended; durable on return.

        Raises
        ------
        InvalidAppend
            Some points have not ended.
        """
        missing = self._count - self.watermark
        if missing:
            raise InvalidAppend(f"{missing} points of block {self._part.index} have not ended")
        self._write_part(part.final_name(self._part.index), self._trimmed(), b"")
        for path in (self._files.folder / PARTS).glob(f"{self._part.index:05d}-a*"):
            path.unlink(missing_ok=True)

    def _add_rows(self, rows: SectionRows) -> int:
        index = self._row(rows.point)
        count, known = len(rows.time), int(self._part.counts[index])
        width = len(self._layout.observables)
        if rows.values.shape != (count, width):
            raise InvalidAppend(f"sections need shape {(count, width)}, not {rows.values.shape}")
        if rows.first != known or known + count > self._layout.record:
            raise InvalidAppend(
                f"point {rows.point} has {known} of {self._layout.record} sections; sections"
                f" {rows.first} to {rows.first + count - 1} do not follow"
            )
        if self._part.status[index] in ENDED:
            raise InvalidAppend(f"point {rows.point} has ended and takes no more sections")
        points, sections = self._layout.chunk
        row, within = divmod(rows.point, points)
        taken = 0
        while taken < count:
            column, start = divmod(known + taken, sections)
            step = min(sections - start, count - taken)
            chunk = self._part.open.get((row, column))
            if chunk is None:
                chunk = self._part.open[row, column] = self._new_chunk()
            chunk[:-1, within, start : start + step] = rows.values[taken : taken + step].T
            chunk[-1, within, start : start + step] = rows.time[taken : taken + step]
            taken += step
        self._part.counts[index] = known + count
        return row

    def _add_end(self, end: PointEnd) -> int:
        index = self._row(end.point)
        if self._part.status[index] in ENDED:
            raise InvalidAppend(f"point {end.point} ended before")
        if end.code:
            self._part.failures[end.point] = Failure(end.code, end.detail, float(end.time))
        self._part.status[index] = PointStatus.failed if end.code else PointStatus.done
        if end.peaks.size:
            self._part.peaks[index] = end.peaks
        for group, numbers in ((STATISTICS, end.statistics), (INDICATORS, end.indicators)):
            for name, value in numbers.items():
                if name in self._layout.coordinates:
                    raise InvalidAppend(f"{name!r} is an axis of the map, and no number of a point")
                self._part.column(f"{group}/{name}")[index] = value
        if end.reason:
            self._part.reasons[end.point] = end.reason
        if end.document is not None:
            self._part.documents[end.point] = end.document
        return end.point // self._layout.chunk[0]

    def _write_full_chunks(self, row: int) -> None:
        """Write the chunks of one row of the grid that can get no more sections.

        A row that has points of other blocks too stays in the part, until the study is sealed.
        """
        points, sections = self._layout.chunk
        begin = row * points - self._first
        end = min((row + 1) * points, self._layout.points) - self._first
        if begin < 0 or end > self._count:
            return
        members = slice(begin, end)
        going = ~has_ended(self._part.status[members])
        counts = self._part.counts[members][going]
        passed = int(counts.min()) // sections if going.any() else self._layout.record
        full = sorted(key for key in self._part.open if key[0] == row and key[1] < passed)
        for key in full:
            self._files.write(chunk_files(self._layout, key, self._part.open[key]), path_of(key))
            del self._part.open[key]

    def _trimmed(self) -> dict[tuple[int, int], Floats]:
        """Open chunks without the columns that no point has reached."""
        return {key: chunk[:, :, : _last(chunk[-1])] for key, chunk in self._part.open.items()}

    def _write_part(self, name: str, chunks: dict[tuple[int, int], Floats], carried: bytes) -> None:
        """Write a part; the chunks that it builds on are on the disk."""
        shown = replace(self._part, open=chunks, carried=carried)
        self._files.write_other(f"{PARTS}/{name}", [shown.encode(self._layout)])

    def _new_chunk(self) -> Floats:
        return np.full((len(self._layout.observables) + 1, *self._layout.chunk), np.nan)

    def _row(self, point: int) -> int:
        row = point - self._first
        if not 0 <= row < self._count:
            raise InvalidAppend(
                f"point {point} is not one of the {self._count} from {self._first} on that block"
                f" {self._part.index} has"
            )
        return row


def chunk_files(
    layout: StudyLayout, key: tuple[int, int], chunk: Floats
) -> Iterator[tuple[str, bytes]]:
    """Give path and content of the file of one chunk in each array of sections.

    `chunk` is (observables + 1, points, sections), times last, by (row, column) in the grid.
    """
    for path, values in zip(paths_at(layout, key), chunk, strict=True):
        yield path, shards.compress(values)


def written_chunks(files: Running, layout: StudyLayout, found: Part) -> Iterator[tuple[str, bytes]]:
    """Give path and content of the chunks that a block wrote before a part.

    Raises
    ------
    CorruptStore
        A chunk is missing, or has other bytes than were written.
    """
    for key in found.written(layout):
        try:
            yield from files.chunks(path_of(key))
        except FileNotFoundError as error:
            raise lost(files, found.index, key) from error


def require_chunks(files: Running, layout: StudyLayout, found: Part) -> None:
    """Raise `CorruptStore` if a chunk that a part builds on is missing, or has other bytes."""
    for _ in written_chunks(files, layout, found):
        pass


def lost(files: Running, index: int, key: tuple[int, int]) -> LostObject:
    """Return the error for a chunk that a block had written and that is gone."""
    return LostObject(f"{files.name} lacks {path_of(key)}, which block {index} had written")


def path_of(key: tuple[int, int]) -> str:
    """Return the key of some array's chunk at an index of the grid."""
    return f"sections/{TIME}/c/{key[0]}/{key[1]}"


def paths_at(layout: StudyLayout, key: tuple[int, int]) -> list[str]:
    """Return the keys of the chunks of all arrays at an index of the grid."""
    names = [*(spec.name for spec in layout.observables), TIME]
    return [f"sections/{name}/c/{key[0]}/{key[1]}" for name in names]


def _last(times: Floats) -> int:
    """Count the columns of a (points, sections) array up to the last one with a number."""
    reached = np.flatnonzero(np.isfinite(times).any(axis=0))
    return int(reached[-1]) + 1 if len(reached) else 0
