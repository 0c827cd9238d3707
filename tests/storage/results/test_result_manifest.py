"""The manifest notices every change of a sealed store."""

import json
from zipfile import ZipFile

import pytest
from made_up_runs import MadeUpRun, made_up_impacts, made_up_layout

from jointplay.storage.errors import CorruptStore, NotAStore
from jointplay.storage.packed import Packed, files_at, pack
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.results.writer import ResultWriter


@pytest.fixture
def store(tmp_path):
    run = MadeUpRun(made_up_layout(samples=30, sections=3), made_up_impacts(4))
    return run.write(tmp_path / "store")


def repack(store, change):
    """Let somebody change the files of a store and pack it again."""
    with ZipFile(store) as archive:
        found = {name: archive.read(name) for name in archive.namelist()}
    change(found)
    store.write_bytes(b"".join(pack(found.items())))


def test_an_untouched_store_verifies(store):
    ResultReader(store).verify()


def test_every_file_is_listed_with_its_size(store):
    with ZipFile(store) as archive:
        listed = json.loads(archive.read("MANIFEST.json"))["files"]
        present = {one.filename: one.file_size for one in archive.infolist()}
    assert list(present).pop() == "MANIFEST.json"
    del present["MANIFEST.json"]
    assert {key: entry["bytes"] for key, entry in listed.items()} == present


@pytest.mark.parametrize(
    "key", ["slider7.q0/c/1", "time/zarr.json", "zarr.json", "peaks/maximum/c/0"]
)
def test_a_flipped_bit_is_found_and_the_file_named(store, key):
    files = files_at(store)
    assert isinstance(files, Packed)
    offset, size, _ = files.entry(key)
    content = bytearray(store.read_bytes())
    content[offset + size // 2] ^= 4
    store.write_bytes(content)
    with pytest.raises(CorruptStore, match=f"{key} of .* has other bytes"):
        ResultReader(store).verify()


def test_a_missing_file_is_found(store):
    repack(store, lambda found: found.pop("impacts/onset/c/0"))
    with pytest.raises(CorruptStore, match="impacts/onset/c/0 is missing"):
        ResultReader(store).verify()


def test_an_added_chunk_is_found(store):
    repack(store, lambda found: found.update({"time/c/7": b""}))
    with pytest.raises(CorruptStore, match="time/c/7 was added"):
        ResultReader(store).verify()


def test_many_findings_make_a_short_sentence(store):
    def empty(found):
        found.update(dict.fromkeys((key for key in found if "/c/" in key), b""))

    repack(store, empty)
    with pytest.raises(CorruptStore, match=r"and \d+ more") as found:
        ResultReader(store).verify()
    assert len(str(found.value)) < 500


def test_a_store_that_was_not_sealed_has_nothing_to_verify(tmp_path):
    ResultWriter.create(tmp_path / "store", made_up_layout(samples=3, sections=0))
    with pytest.raises(NotAStore, match="not sealed"):
        ResultReader(tmp_path / "store").verify()
