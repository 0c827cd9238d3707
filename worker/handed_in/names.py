"""Names of files that a block may write: no block's are another's."""

import re
from typing import Final

from jointplay.storage.attempt_files import SEALED, STUDY
from jointplay.storage.catalogue.errors import CatalogueError, Fenced
from jointplay.storage.catalogue.records import Block, Job
from jointplay.storage.packed.running import DOCUMENTS, PARTS, ROWS
from jointplay.storage.results.examination import LARGEST_DOCUMENT
from jointplay.storage.studies.examined_part import LARGEST_PART, largest_rows
from jointplay.storage.studies.layout import StudyLayout
from jointplay.storage.studies.part import final_name, name_of
from jointplay.worker.handed_in.expected import Expected

STUDY_DOCUMENTS: Final = f"{STUDY}/{DOCUMENTS}"
_PART: Final = re.compile(rf"{STUDY}/{PARTS}/(\d{{5}})(?:-a([1-9]\d{{0,8}}))?")
_ROWS: Final = re.compile(rf"{STUDY}/{ROWS}/sections-(\d{{1,9}})-(\d{{1,9}})\.zip")


class NotOwn(Fenced):
    """A name is another block's, or another attempt's."""

    def __init__(self, block: str, attempt: int, name: str) -> None:
        sentence = f"attempt {attempt} at block {block} does not hold {name!r}, which is another's"
        CatalogueError.__init__(self, sentence)


def is_run(job: Job) -> bool:
    """Whether a job is one run, which is one block and has files of each attempt."""
    return job.kind == "simulate"


def writes(name: str, job: Job, block: Block, expected: Expected) -> bool:
    """Whether an attempt, as it claimed its block, may store a file of this name."""
    if is_run(job):
        own = f"a{block.attempt}/", f"block0-a{block.attempt}", f"{SEALED}{block.attempt}"
        return name in own[1:] or name.startswith(own[0])
    if block.count == 0:
        return name == f"{SEALED}{STUDY}"
    parts = final_name(block.index), name_of(block.index, block.attempt)
    known = {STUDY_DOCUMENTS, *(f"{STUDY}/{PARTS}/{part}" for part in parts)}
    return name in known or _is_own_row(name, block, expected)


def removes(name: str, job: Job, block: Block, expected: Expected) -> bool:
    """Whether it may remove one: of its block's parts those of attempts before, too."""
    part = _PART.fullmatch(name)
    if part is not None and not is_run(job):
        own = int(part[1]) == block.index and int(part[2] or 0) <= block.attempt
        return block.count > 0 and own
    return name != STUDY_DOCUMENTS and writes(name, job, block, expected)


def largest(name: str, expected: Expected) -> int:
    """Return the bytes that a file of a name may have: what is read whole is small."""
    if name.endswith(f"/{DOCUMENTS}"):
        return LARGEST_DOCUMENT
    if _PART.fullmatch(name):
        return LARGEST_PART
    if _ROWS.fullmatch(name) and isinstance(expected.layout, StudyLayout):
        return largest_rows(expected.layout)
    return expected.most


def _is_own_row(name: str, block: Block, expected: Expected) -> bool:
    """Whether a file has chunks of sections of points of this block alone."""
    found = _ROWS.fullmatch(name)
    layout = expected.layout
    if found is None or not isinstance(layout, StudyLayout):
        return found is not None and layout is None
    points, sections = layout.chunk
    row, column = int(found[1]), int(found[2])
    end = min((row + 1) * points, layout.points)
    inside = block.first <= row * points < end <= block.first + block.count
    return inside and column * sections < layout.record
