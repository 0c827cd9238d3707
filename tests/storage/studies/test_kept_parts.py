"""A look at a growing study reads what is new: the work is counted."""

from collections import Counter

import numpy as np
import pytest
from made_up_studies import MadeUpStudy, made_up_map

from jointplay.storage import durable
from jointplay.storage.errors import CorruptStore
from jointplay.storage.studies import examined_part, snapshot
from jointplay.storage.studies.block import StudyBlock
from jointplay.storage.studies.kept_parts import KeptParts
from jointplay.storage.studies.part import Part
from jointplay.storage.studies.reader import StudyReader
from jointplay.storage.studies.store import create

BLOCKS = 5


@pytest.fixture
def reads(monkeypatch):
    """Return how often each part was read from its file."""
    found: Counter[str] = Counter()

    class Counted(Part):
        @classmethod
        def read(cls, files, name, digest):
            found[name] += 1
            return Part.read(files, name, digest)

    monkeypatch.setattr(examined_part, "Part", Counted)
    return found


@pytest.fixture
def keeping(monkeypatch):
    kept = KeptParts()
    monkeypatch.setattr(snapshot, "KEPT_PARTS", kept)
    return kept


@pytest.fixture
def growing(tmp_path):
    """Four blocks that are done, and one in which nothing has ended yet."""
    study = MadeUpStudy(made_up_map(5, 8))
    create(tmp_path, study.layout)
    for index in range(BLOCKS):
        block = StudyBlock(tmp_path, study.layout, index)
        if index < BLOCKS - 1:
            for piece in study.slices(index, 100):
                block.take(piece)
            block.finish()
        else:
            block.flush(b"")
    return tmp_path


def looked(folder):
    return {name: values.copy() for name, values in StudyReader(folder).statistics.items()}


def test_a_second_look_reads_only_what_may_have_changed(growing, keeping, reads):
    first = looked(growing)
    assert sorted(reads.values()) == [1] * BLOCKS
    again = looked(growing)
    last = [name for name in reads if not name.isdigit()]
    assert [reads[name] for name in last] == [2]
    assert sum(reads.values()) == BLOCKS + 1
    for name, values in first.items():
        np.testing.assert_array_equal(values, again[name])


def test_a_part_that_is_not_as_it_was_is_read_again(growing, keeping):
    looked(growing)
    (path,) = growing.rglob("parts/00002")
    durable.write(path, [path.read_bytes()[:-1]])
    with pytest.raises(CorruptStore):
        looked(growing)


def test_two_studies_with_parts_of_one_name_have_their_own(growing, keeping, tmp_path_factory):
    other = tmp_path_factory.mktemp("other")
    study = MadeUpStudy(made_up_map(5, 8), seed=1)
    create(other, study.layout)
    for index in range(BLOCKS):
        block = StudyBlock(other, study.layout, index)
        for piece in study.slices(index, 100):
            block.take(piece)
        block.finish()
    assert looked(growing)["steps"].tobytes() != looked(other)["steps"].tobytes()


def test_what_is_kept_is_bounded(growing, monkeypatch, reads):
    size = Part.read(StudyReader(growing).files, "00000", StudyReader(growing).attributes["layout"])
    monkeypatch.setattr(snapshot, "KEPT_PARTS", KeptParts(2 * size.nbytes))
    looked(growing)
    looked(growing)
    assert sum(reads.values()) > BLOCKS + 1
