"""Results of one block of a study that another program handed in, before they are read or counted.

Whoever seals the study takes over what is found here: a fault must be that of the block. Whoever
reads the study while it runs reads what no worker has called done.
"""

import json
import re
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from jointplay.records.names import is_storable
from jointplay.records.peak import PEAK
from jointplay.records.point import PointStatus
from jointplay.storage.errors import CorruptStore, ResultsError
from jointplay.storage.packed.running import PARTS, Running
from jointplay.storage.results import metadata
from jointplay.storage.results.chunk_files import ChunkFiles
from jointplay.storage.results.examination import ODD
from jointplay.storage.studies import documents, part
from jointplay.storage.studies.block import path_of, paths_at
from jointplay.storage.studies.layout import StudyLayout
from jointplay.storage.studies.part import Part
from jointplay.storage.studies.points import INDICATORS, STATISTICS

LARGEST_PART: Final = 2**28
"""Bytes of the file that a block leaves at most."""
MOST_NUMBERS: Final = 4096
"""Statistics and indicators of a point at most."""
_CODE: Final = re.compile(r"[a-z][a-z0-9-]{0,63}")
_LONGEST: Final = 10_000  # characters
_PACKED: Final = 2**16
"""Bytes of a file of chunks at most beside them."""


def require_part(files: Running, layout: StudyLayout, index: int, *, same: bool) -> None:
    """Raise `CorruptStore` if a block did not leave all its points, with the chunks before them.

    Parameters
    ----------
    files
        Of the running study, whose documents say by what digest it is known.
    same
        Whether the solver is the one that gave this layout: others may have other numbers.
    """
    try:
        found = Part.read(files, part.final_name(index), files.digest.decode())
        _require_points(found, layout)
        _require_ended(found)
        _require_names(found, layout, same=same)
        _require_words(found)
        _require_chunks(files, found, layout)
    except FileNotFoundError as error:
        raise CorruptStore(f"block {index} left no {PARTS}/{part.final_name(index)}") from error
    except CorruptStore:
        raise
    except (*ODD, ResultsError) as error:
        raise CorruptStore(f"what block {index} left cannot be read: {error}") from error


def sound_part(files: Running, name: str, digest: str, layout: StudyLayout) -> Part:
    """Return what is known of a block, which may go on, as `Part.read` does; or raise as it does.

    It is examined as the results of a block that is done are, but for chunks.
    """
    try:
        found = Part.read(files, name, digest)
        _require_points(found, layout)
        _require_names(found, layout, same=False)
        _require_words(found)
    except (FileNotFoundError, ResultsError):
        raise
    except ODD as error:
        raise CorruptStore(f"{PARTS}/{name} is none of the job: {error}") from error
    return found


def largest_rows(layout: StudyLayout) -> int:
    """Return the bytes of a file of chunks of sections at most."""
    arrays = _sections(layout).values()
    return sum(one.largest for one in arrays) + _PACKED


def _require_points(found: Part, layout: StudyLayout) -> None:
    """Raise `CorruptStore` if arrays are not those of the block's points."""
    first, count = layout.blocks[found.index]
    points, sections = layout.chunk
    width = len(layout.observables) + 1
    sound = (
        _is(found.status, (count,))
        and _is(found.counts, (count,))
        and _is(found.peaks, (count, len(layout.channels), len(PEAK)))
        and all(_is(one, (count,)) for one in found.numbers.values())
    )
    rows = range(first // points, -(-(first + count) // points))
    for (row, column), one in found.open.items():
        sound &= row in rows and 0 <= column * sections < max(layout.record, 1)
        sound &= one.ndim == 3 and one.shape[2] <= sections
        sound &= _is(one, (width, points, one.shape[-1]))
    if not sound:
        raise CorruptStore(f"what block {found.index} left has other shapes than the job gives")
    counts = found.counts
    if counts.min() < 0 or counts.max() > layout.record:
        raise CorruptStore(f"block {found.index} has sections that the job does not record")
    own = {*range(first, first + count)}
    if {*found.reasons, *found.documents} - own:
        raise CorruptStore(f"what block {found.index} left is of other blocks, too")
    failed = first + np.flatnonzero(found.status == PointStatus.failed)
    if {*failed.tolist()} != found.failures.keys():
        raise CorruptStore(f"block {found.index} does not say why its points failed")


def _require_ended(found: Part) -> None:
    """Raise `CorruptStore` if points of a block that is done have not ended."""
    if left := found.status.size - found.ended:
        raise CorruptStore(f"{left} points of block {found.index} have not ended")


def _is(array: NDArray[Any], shape: tuple[int, ...]) -> bool:
    return array.shape == shape and array.dtype.kind in "fiu"


def _require_names(found: Part, layout: StudyLayout, *, same: bool) -> None:
    """Raise `CorruptStore` if a number of a point is none that a point of this study can have."""
    for path in found.numbers:
        group, _, name = path.partition("/")
        known = name in layout.outputs if same else is_storable(name)
        if group not in (STATISTICS, INDICATORS) or not known or name in layout.coordinates:
            raise CorruptStore(f"{path!r} is no number of a point")
    if len(found.numbers) > MOST_NUMBERS:
        raise CorruptStore(f"block {found.index} has more numbers of a point than there can be")


def _require_words(found: Part) -> None:
    """Raise `CorruptStore` if sentences are none that a sealed study can have."""
    failures = [*found.failures.values()]
    texts = [*found.reasons.values()]
    texts += [text for one in failures for text in (one.code, one.detail)]
    if not all(isinstance(one, str) for one in texts):
        raise CorruptStore("a reason is no text")
    if max(map(len, texts), default=0) > _LONGEST:
        raise CorruptStore("a reason is longer than there can be")
    if not all(_CODE.fullmatch(one.code) for one in failures):
        raise CorruptStore("the code of a failure is no word")
    if not all(one.replace("\n", " ").isprintable() for one in texts):
        raise CorruptStore("a reason has characters that no text has")
    if not all(isinstance(one, dict) for one in found.documents.values()):
        raise CorruptStore("a result is no object")
    if not all(type(one.time) is float or type(one.time) is int for one in failures):
        raise CorruptStore("a time is no number")
    _ = [float(one.time) for one in failures]
    json.dumps([*found.documents.values()], allow_nan=False)


def _require_chunks(files: Running, found: Part, layout: StudyLayout) -> None:
    """Raise `CorruptStore` if a chunk that the block wrote is missing, or is none."""
    arrays = _sections(layout)
    for key in found.written(layout):
        there = dict(files.chunks(path_of(key)))
        if sorted(there) != sorted(paths_at(layout, key)):
            raise CorruptStore(f"chunks at {path_of(key)} are not those of the job")
        for path, content in there.items():
            array, _, index = path.rpartition("/c/")
            arrays[array].check(index, content)


def _sections(layout: StudyLayout) -> dict[str, ChunkFiles]:
    return {
        path: ChunkFiles(path, one)
        for path, one in metadata.arrays_among(documents.sealed(layout, (), {})).items()
        if path.startswith("sections/")
    }
