"""Results in a folder."""

import errno
import os
from pathlib import Path

import pytest

from jointplay.storage.object_stores import OBJECT_STORES, ObjectStore, object_store_at
from jointplay.storage.object_stores.folder import Folder
from tests.storage.object_stores.contract import CONTENT, KEY, CutOff, ObjectStoreContract, pieces


class TestFolder(ObjectStoreContract):
    """The contract."""

    @pytest.fixture
    def object_store(self, tmp_path: Path) -> ObjectStore:
        return Folder(str(tmp_path / "results"))

    def raw_get(self, object_store: ObjectStore, key: str) -> bytes | None:
        assert isinstance(object_store, Folder)
        path = Path(object_store.root) / key
        return path.read_bytes() if path.exists() else None

    def raw_set(self, object_store: ObjectStore, key: str, content: bytes) -> None:
        assert isinstance(object_store, Folder)
        path = Path(object_store.root) / key
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


@pytest.fixture
def folder(tmp_path: Path) -> Folder:
    return Folder(str(tmp_path))


def test_what_a_killed_process_left_goes_with_its_job(folder: Folder, tmp_path: Path) -> None:
    partial = tmp_path / f"{KEY}.0123abcd.partial"
    partial.parent.mkdir()
    partial.write_bytes(CONTENT[:100])
    assert list(folder.list("")) == []
    for prefix, found in {"": [f"{KEY}.0123abcd.partial"], "2R/other-": []}.items():
        assert list(folder.cut_off(prefix)) == found
    folder.remove("2R/job-")
    assert list(folder.cut_off("")) == []
    assert not partial.exists()


def test_a_put_that_fails_leaves_no_file(folder: Folder, tmp_path: Path) -> None:
    with pytest.raises(CutOff):
        folder.put(KEY, pieces(until=100))
    assert [path for path in tmp_path.rglob("*") if path.is_file()] == []


def test_where_files_cannot_be_linked_they_are_renamed_and_copied(
    folder: Folder, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(source: Path, target: Path) -> None:
        raise OSError(errno.EPERM, "this file system has no links")

    monkeypatch.setattr(os, "link", refuse)
    folder.put(KEY, pieces())
    assert folder.adopt("2R/job-a2", KEY)
    for key in (KEY, "2R/job-a2"):
        assert (tmp_path / key).read_bytes() == CONTENT
    with pytest.raises(FileExistsError):
        folder.put(KEY, pieces())


def test_the_file_is_on_the_disk_before_its_name_is(
    folder: Folder, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A power cut takes away what was not synced: first the content, then the names."""
    steps: list[str] = []
    fsync, link = os.fsync, os.link

    def synced(descriptor: int) -> None:
        fsync(descriptor)
        steps.append(Path(f"/proc/self/fd/{descriptor}").readlink().name)

    def linked(source: Path, target: Path) -> None:
        link(source, target)
        steps.append("link")

    monkeypatch.setattr(os, "fsync", synced)
    monkeypatch.setattr(os, "link", linked)
    folder.put(KEY, pieces())
    content = next(index for index, step in enumerate(steps) if step.endswith(".partial"))
    assert steps[content + 1 :] == ["link", "2R"]


def test_an_address_names_its_store(tmp_path: Path) -> None:
    assert object_store_at(f"file:{tmp_path}") == Folder(str(tmp_path))
    for address in ("nowhere", "ftp:/x", ""):
        with pytest.raises(ValueError, match="addresses begin with file:"):
            object_store_at(address)
    assert "file" in OBJECT_STORES
