"""Specification of every object store; a store's own tests subclass this.

They give the store, and how an object gets in and out past it, so that no store is asked about
itself alone.
"""

import threading
from abc import ABC, abstractmethod
from collections.abc import Iterator

import pytest

from jointplay.storage.object_stores import ObjectStore, StoredObject

KEY = "2R/job-a1.zarr.zip"
CONTENT = bytes(range(256)) * 20


class CutOff(Exception):
    """Stands for the end of a process while it stores an object."""


def pieces(content: bytes = CONTENT, *, until: int | None = None) -> Iterator[bytes]:
    """Give a content in pieces of uneven length, up to a byte at which the process ends."""
    at, step = 0, 1
    while at < len(content):
        if until is not None and at >= until:
            raise CutOff
        yield content[at : at + step]
        at, step = at + step, step * 3
    yield b""


class ObjectStoreContract(ABC):
    """One test for each promise of `storage.object_stores.ObjectStore`."""

    @abstractmethod
    def raw_get(self, object_store: ObjectStore, key: str) -> bytes | None:
        """Return an object's bytes without asking the store; None if there is none."""

    @abstractmethod
    def raw_set(self, object_store: ObjectStore, key: str, content: bytes) -> None:
        """Put an object there without asking the store."""

    @pytest.fixture
    @abstractmethod
    def object_store(self) -> ObjectStore:
        """An empty store."""

    def test_what_is_put_is_there(self, object_store: ObjectStore) -> None:
        object_store.put(KEY, pieces())
        assert self.raw_get(object_store, KEY) == CONTENT

    def test_a_version_is_that_of_the_bytes(self, object_store: ObjectStore) -> None:
        assert object_store.version(KEY) is None
        self.raw_set(object_store, KEY, CONTENT)
        first = object_store.version(KEY)
        assert first is not None
        assert object_store.version(KEY) == first
        self.raw_set(object_store, KEY, b"x" + CONTENT)
        assert object_store.version(KEY) not in (None, first)

    @pytest.mark.parametrize("content", [b"", b"x", CONTENT])
    def test_what_is_there_is_read(self, object_store: ObjectStore, content: bytes) -> None:
        self.raw_set(object_store, KEY, content)
        assert object_store.size(KEY) == len(content)
        assert object_store.read(KEY, 0, len(content)) == content
        assert StoredObject(object_store, KEY).exists()

    @pytest.mark.parametrize(
        ("start", "stop"), [(0, 1), (0, 0), (17, 300), (5119, 5120), (5000, 9999), (6000, 7000)]
    )
    def test_a_range_is_a_slice(self, object_store: ObjectStore, start: int, stop: int) -> None:
        self.raw_set(object_store, KEY, CONTENT)
        assert object_store.read(KEY, start, stop) == CONTENT[start:stop]

    def test_what_is_not_there_is_said_to_be_missing(self, object_store: ObjectStore) -> None:
        self.raw_set(object_store, KEY, CONTENT)
        missing = StoredObject(object_store, "2R/job-a2.zarr.zip")
        assert not missing.exists()
        with pytest.raises(FileNotFoundError):
            missing.size()
        with pytest.raises(FileNotFoundError):
            missing.read(0, 1)
        assert not object_store.adopt("2R/other", missing.key)
        assert not StoredObject(object_store, "2R/other").exists()
        object_store.remove("2R/nothing")

    def test_an_object_is_written_once(self, object_store: ObjectStore) -> None:
        self.raw_set(object_store, KEY, CONTENT)
        with pytest.raises(FileExistsError):
            object_store.put(KEY, pieces(b"other"))
        assert self.raw_get(object_store, KEY) == CONTENT

    def test_what_a_running_job_needs_is_replaced(self, object_store: ObjectStore) -> None:
        for content in (CONTENT, b"shorter", CONTENT * 2):
            object_store.replace(KEY, pieces(content))
            assert self.raw_get(object_store, KEY) == content
        with pytest.raises(CutOff):
            object_store.replace(KEY, pieces(b"other" * 999, until=2000))
        assert self.raw_get(object_store, KEY) == CONTENT * 2
        assert list(object_store.list("")) == [KEY]

    @pytest.mark.parametrize("until", [0, 1, 2000])
    def test_a_put_that_is_cut_off_leaves_nothing_to_be_seen(
        self, object_store: ObjectStore, until: int
    ) -> None:
        with pytest.raises(CutOff):
            object_store.put(KEY, pieces(until=until))
        assert self.raw_get(object_store, KEY) is None
        assert list(object_store.list("")) == []
        object_store.put(KEY, pieces())
        assert self.raw_get(object_store, KEY) == CONTENT

    def test_a_put_that_is_under_way_can_be_told_from_objects(
        self, object_store: ObjectStore
    ) -> None:
        seen = []

        def watched() -> Iterator[bytes]:
            for piece in pieces():
                seen.extend(object_store.cut_off(""))
                yield piece

        object_store.put(KEY, watched())
        assert all(one.startswith(KEY) and one != KEY for one in seen)
        assert list(object_store.cut_off("")) == []

    def test_an_object_being_put_is_not_seen_before_it_is_whole(
        self, object_store: ObjectStore
    ) -> None:
        seen = []

        def watched() -> Iterator[bytes]:
            for piece in pieces():
                seen.append((self.raw_get(object_store, KEY), list(object_store.list(""))))
                yield piece

        object_store.put(KEY, watched())
        assert seen == [(None, [])] * len(seen)
        assert len(seen) > 5

    def test_of_several_who_put_at_once_one_succeeds(self, object_store: ObjectStore) -> None:
        contents = [bytes([number]) * 10_000 for number in range(6)]
        together = threading.Barrier(len(contents))
        outcomes: list[bytes | None] = []

        def put(content: bytes) -> None:
            together.wait()
            try:
                object_store.put(KEY, pieces(content))
                outcomes.append(content)
            except FileExistsError:
                outcomes.append(None)

        writers = [threading.Thread(target=put, args=(content,)) for content in contents]
        for writer in writers:
            writer.start()
        for writer in writers:
            writer.join()
        (kept,) = [content for content in outcomes if content is not None]
        assert len(outcomes) == len(contents)
        assert self.raw_get(object_store, KEY) == kept

    def test_keys_are_listed_by_what_they_begin_with(self, object_store: ObjectStore) -> None:
        keys = ["2R/a-1", "2R/a-2", "2R/b-1", "3R/a-1", "2R/a"]
        for key in keys:
            self.raw_set(object_store, key, b"x")
        assert sorted(object_store.list("")) == sorted(keys)
        assert sorted(object_store.list("2R/a-")) == ["2R/a-1", "2R/a-2"]
        assert sorted(object_store.list("2R/")) == ["2R/a", "2R/a-1", "2R/a-2", "2R/b-1"]
        assert list(object_store.list("2R/c")) == list(object_store.list("4R/")) == []

    def test_what_begins_so_is_removed_and_nothing_else(self, object_store: ObjectStore) -> None:
        for key in ("2R/a-1", "2R/a-2", "2R/b-1"):
            self.raw_set(object_store, key, b"x")
        object_store.remove("2R/a-")
        assert list(object_store.list("")) == ["2R/b-1"]
        assert self.raw_get(object_store, "2R/a-1") is None

    def test_what_a_lost_attempt_stored_is_adopted(self, object_store: ObjectStore) -> None:
        self.raw_set(object_store, "2R/job-a1", CONTENT)
        assert object_store.adopt("2R/job-a2", "2R/job-a1")
        assert self.raw_get(object_store, "2R/job-a2") == CONTENT
        object_store.remove("2R/job-a1")
        assert self.raw_get(object_store, "2R/job-a2") == CONTENT
        self.raw_set(object_store, "2R/job-a3", b"another")
        assert object_store.adopt("2R/job-a2", "2R/job-a3")  # what is there already stays
        assert self.raw_get(object_store, "2R/job-a2") == CONTENT
