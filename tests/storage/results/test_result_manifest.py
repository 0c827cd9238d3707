"""The manifest notices every change of a sealed store."""

import json

import pytest
from made_up_runs import MadeUpRun, made_up_impacts, made_up_layout

from jointplay.storage.results import CorruptStore, NotAStore, ResultReader, ResultWriter, manifest


@pytest.fixture
def store(tmp_path):
    run = MadeUpRun(made_up_layout(samples=30, sections=3), made_up_impacts(4))
    (tmp_path / "store").mkdir()
    (tmp_path / "store/job.json").write_text("{}")
    return run.write(tmp_path / "store")


def test_an_untouched_store_verifies(store):
    ResultReader(store).verify()


def test_every_file_is_listed_with_its_size(store):
    listed = json.loads((store / "MANIFEST.json").read_bytes())["files"]
    present = {
        path.relative_to(store).as_posix(): path.stat().st_size
        for path in store.rglob("*")
        if path.is_file()
    }
    del present["MANIFEST.json"]
    assert {key: entry["bytes"] for key, entry in listed.items()} == present
    assert "job.json" in listed


@pytest.mark.parametrize(
    "key", ["slider7.q0/c/1", "time/zarr.json", "zarr.json", "job.json", "peaks/maximum/c/0"]
)
def test_a_flipped_bit_is_found_and_the_file_named(store, key):
    content = bytearray((store / key).read_bytes())
    content[len(content) // 2] ^= 4
    (store / key).write_bytes(content)
    with pytest.raises(CorruptStore, match=f"{key} has other bytes"):
        manifest.verify(store)


def test_a_missing_file_is_found(store):
    (store / "impacts/onset/c/0").unlink()
    with pytest.raises(CorruptStore, match="impacts/onset/c/0 is missing"):
        ResultReader(store).verify()


def test_an_added_chunk_is_found(store):
    (store / "time/c/7").write_bytes(b"")
    with pytest.raises(CorruptStore, match="time/c/7 was added"):
        ResultReader(store).verify()


def test_many_findings_make_a_short_sentence(store):
    for path in store.rglob("c/*"):
        path.write_bytes(b"")
    with pytest.raises(CorruptStore, match=r"and \d+ more") as found:
        ResultReader(store).verify()
    assert len(str(found.value)) < 500


def test_a_store_that_was_not_sealed_has_nothing_to_verify(tmp_path):
    ResultWriter.create(tmp_path / "store", made_up_layout(samples=3, sections=0))
    with pytest.raises(NotAStore, match="never sealed"):
        ResultReader(tmp_path / "store").verify()
