"""A study's store as a whole: made by whichever block comes first, sealed when all are done."""

import json
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import chain
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from jointplay.records.peak import PEAK
from jointplay.records.point import Failure, PointStatus
from jointplay.records.run import Floats
from jointplay.storage.errors import (
    CorruptStore,
    IncompleteStudy,
    LostObject,
    NotAStore,
    StoreExists,
)
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.packed import Running, pack
from jointplay.storage.packed.ranges import InParts
from jointplay.storage.packed.running import DOCUMENTS
from jointplay.storage.results import manifest, metadata, shards
from jointplay.storage.studies import documents, part
from jointplay.storage.studies.block import chunk_files, written_chunks
from jointplay.storage.studies.cut import Band, bands, chunk_shape, chunks
from jointplay.storage.studies.layout import StudyLayout
from jointplay.storage.studies.part import Part
from jointplay.storage.studies.points import Points, failure_codes, ordered, together

FAILURES: Final = "failures.json"
"""Failed points with code, sentence and time reached: what no array can hold."""
REASONS: Final = "reasons.json"
"""Grounds of verdicts by point."""
RESULTS: Final = "results.json"
"""Results by point that are no numbers, such as what a calibration found."""


def create(folder: Path, layout: StudyLayout) -> None:
    """Make an empty store, or find that this study's store is there already.

    Several processes may do it at once: each writes the same bytes, whole files at a time.

    Raises
    ------
    StoreExists
        The folder holds a store of something else, or of the same study computed by another
        version of the program.
    """
    present = _attributes(folder)
    if present is not None and present.get("layout") == layout.digest:
        return
    if present is not None:
        raise StoreExists(
            f"{folder} holds other results, or some of this study from another version of"
            " the program; choose another folder, or submit the study again"
        )
    shown = metadata.serialised(documents.running(layout))
    files = Running(folder, digest=layout.digest)
    files.write_documents(chain(_values(layout), shown))


def discard_others(folder: Path, layout: StudyLayout) -> bool:
    """Remove another study's documents from a folder that is one job's own, where they are damage.

    Those of the same job by another version of the program stay. Returns whether any were removed.
    """
    present = _attributes(folder)
    if present is None or present.get("job") == layout.attributes.get("job"):
        return False
    (folder / DOCUMENTS).unlink(missing_ok=True)
    return True


def _attributes(folder: Path) -> dict[str, Any] | None:
    """Return what the store in a folder says of itself; None: there is none, or it is damaged."""
    try:
        found: dict[str, Any] = json.loads(Running(folder).read(metadata.FILE))["attributes"]
    except (NotAStore, CorruptStore, FileNotFoundError, ValueError, KeyError, TypeError):
        return None
    return found


def seal(
    folder: Path,
    layout: StudyLayout,
    target: StoredObject,
    advanced: Callable[[], None] = lambda: None,
) -> None:
    """Pack a study whose blocks are all done; it is durable, and never changes, on return.

    May be repeated, also after an interruption and by several processes. The folder stays, for
    those who read it; memory is bounded by the part of one block.

    Parameters
    ----------
    folder, layout
        As for `create`.
    target
        Where the packed store goes.
    advanced
        Called now and then; a large store takes a while.

    Raises
    ------
    IncompleteStudy
        A block is not done.
    CorruptStore
        What a block left is damaged or missing.
    StoreExists
        Something else is at the target: of two seals that differ none can be relied upon.
    """
    pieces = pack(manifest.listed(_files(folder, layout, advanced)))
    try:
        if target.exists():
            _require_same(target, pieces)
        else:
            target.put(pieces)
    except FileExistsError:  # by another process in the meantime
        seal(folder, layout, target, advanced)
    except (FileNotFoundError, LostObject, IncompleteStudy):
        if not target.exists():
            raise  # else the job ended with it, and what it needed went


def _require_same(target: StoredObject, pieces: Iterable[bytes]) -> None:
    """Raise `StoreExists` if what is sealed already has other bytes."""
    at, stored = 0, InParts(str(target), target)
    for piece in pieces:
        if stored.read(at, at + len(piece)) != piece:
            break
        at += len(piece)
    else:
        if at == stored.size():
            return
    raise StoreExists(f"{target} was sealed before, with other bytes; submit the study again")


def _files(
    folder: Path, layout: StudyLayout, advanced: Callable[[], None]
) -> Iterator[tuple[str, bytes]]:
    """Give key and content of every file of the sealed store, in the same order always."""
    files = Running(folder, digest=layout.digest)
    there = frozenset(files.parts())
    finals = [part.final_name(index) for index in range(len(layout.blocks))]
    missing = [index for index, name in enumerate(finals) if name not in there]
    if missing:
        raise IncompleteStudy(
            f"{len(missing)} blocks of {folder} are not done, such as {missing[0]}"
        )

    def part_of(index: int) -> Part:
        advanced()
        return Part.read(files, finals[index], layout.digest)

    names, failures, reasons, found, ended = _survey(part_of, layout)
    codes = failure_codes(failures)
    yield from _values(layout, names)
    yield from _columns(part_of, layout, names, codes)
    for index in range(len(finals)):
        yield from written_chunks(files, layout, part_of(index))
    yield from _boundary_chunks(part_of, layout)
    if failures:
        yield FAILURES, metadata.serialise(_as_json(failures))
    if reasons:
        yield REASONS, metadata.serialise({str(point): one for point, one in reasons.items()})
    if found:
        yield RESULTS, metadata.serialise({str(point): one for point, one in found.items()})
    attributes = {"complete": True, "failures": ["", *codes], "summary": ended}
    yield from metadata.serialised(documents.sealed(layout, names, attributes))


def _survey(
    part_of: Callable[[int], Part], layout: StudyLayout
) -> tuple[
    list[str], dict[int, Failure], dict[int, str], dict[int, Mapping[str, Any]], dict[str, int]
]:
    """Names of all numbers, failed points, grounds, documents, how many are done and failed."""
    names: set[str] = set()
    failures: dict[int, Failure] = {}
    reasons: dict[int, str] = {}
    found_documents: dict[int, Mapping[str, Any]] = {}
    done = 0
    for index in range(len(layout.blocks)):
        found = part_of(index)
        names |= found.numbers.keys()
        failures |= found.failures
        reasons |= found.reasons
        found_documents |= found.documents
        done += int((found.status == PointStatus.done).sum())
    counted = {"done": done, "failed": len(failures)}
    return ordered(names), failures, reasons, found_documents, counted


def _columns(
    part_of: Callable[[int], Part],
    layout: StudyLayout,
    names: list[str],
    codes: list[str],
) -> Iterator[tuple[str, bytes]]:
    """Every chunk of the arrays with one number, or one of each channel, a point."""
    width = len(layout.channels)

    def numbers(band: Band) -> dict[str, NDArray[Any]]:
        runs = [window(run).scalars(run.start, names, codes) for run in band.points]
        return {name: np.concatenate([run[name] for run in runs]) for name in runs[0]}

    def window(run: slice) -> Points:
        return together(part_of, layout.blocks, width, run.start, run.stop)

    shape = chunk_shape(layout)
    for band in bands(layout):
        for name, column in numbers(band).items():
            for index, chunk in chunks(layout, band, column):
                yield f"{name}/c/{index}", _encoded(chunk, shape)
    if width:
        shape = [*chunk_shape(layout, width), width]
        for band in bands(layout, width):
            peaks = np.concatenate([window(run).peaks for run in band.points])
            for position, name in enumerate(PEAK):
                for index, chunk in chunks(layout, band, peaks[:, :, position], width):
                    yield f"peaks/{name}/c/{index}/0", _encoded(chunk, shape)


def _as_json(failures: dict[int, Failure]) -> dict[str, tuple[str, str, float | None]]:
    """Return failures by point; a time that is not finite, which JSON has not, is null."""
    return {
        str(point): (code, detail, time if math.isfinite(time) else None)
        for point, (code, detail, time) in failures.items()
    }


def _boundary_chunks(
    part_of: Callable[[int], Part], layout: StudyLayout
) -> Iterator[tuple[str, bytes]]:
    """Chunks of sections that belong to several blocks, each of which left its points' rows."""
    points, sections = layout.chunk
    waiting: dict[tuple[int, int], Floats] = {}
    for index, (first, count) in enumerate(layout.blocks):
        for key, rows in part_of(index).open.items():
            if key not in waiting:
                waiting[key] = np.full((len(rows), points, sections), np.nan)
            shown = waiting[key][:, :, : rows.shape[2]]
            np.copyto(shown, rows, where=~np.isnan(rows))
        reached = first + count
        whole = [key for key in waiting if min((key[0] + 1) * points, layout.points) <= reached]
        for key in sorted(whole):
            yield from chunk_files(layout, key, waiting.pop(key))


def _values(layout: StudyLayout, names: Sequence[str] = ()) -> Iterator[tuple[str, bytes]]:
    """Give every chunk of the values of parameters; `names` are those of the points' numbers."""
    for prefix in documents.prefixes_of_values(layout, names):
        for axis, (_, values) in layout.coordinates.items():
            yield f"{prefix}{axis}/c/0", _encoded(values.astype("<f8"), [len(values)])
    for position, spec in enumerate(() if layout.coordinates else layout.parameters):
        for band in bands(layout):
            column = layout.values[band.points[0], position].astype("<f8")
            yield f"values/{spec.name}/c/{band.row}", _encoded(column, chunk_shape(layout))


def _encoded(chunk: NDArray[Any], shape: Sequence[int]) -> bytes:
    """Compress a chunk of this shape, the last one of an array filled up."""
    return shards.compress(shards.filled(chunk, shape))
