"""Specification of every member of the family of files of running jobs; its tests subclass this."""

from abc import ABC, abstractmethod

import pytest

from jointplay.storage.object_stores import ObjectStore
from jointplay.storage.running_files import RunningFiles
from jointplay.storage.running_files.objects import InObjectStore

ROWS = "a1/rows/history-0.zip"
JOURNAL = "a1/parts/00000001"


class RunningFilesContract(ABC):
    """One test for each promise of `storage.running_files.RunningFiles`."""

    @abstractmethod
    def opened(self) -> RunningFiles:
        """The files of one job, as a process that knows nothing of them begins to read them."""

    @abstractmethod
    def raw(self) -> dict[str, bytes]:
        """Name and bytes of all that is kept of the job, past the member."""

    def test_what_is_put_is_there_and_replaced(self) -> None:
        files = self.opened()
        for content in (b"one", b"another", b""):
            files.put("block0-a1", [content[:2], content[2:]])
            assert self.opened().read("block0-a1") == content
            assert self.opened().size("block0-a1") == len(content)
        assert [*self.raw().values()] == [b""]

    def test_a_stamp_changes_with_its_file_or_tells_nothing(self) -> None:
        stamps = []
        assert self.opened().stamp("block0-a1") is None
        for content in (b"one", b"two"):
            self.opened().put("block0-a1", [content])
            stamps.append(self.opened().stamp("block0-a1"))
        self.opened().put("block1-a1", [b"two"])
        stamps.append(self.opened().stamp("block1-a1"))
        assert stamps == [None] * 3 or len({*stamps}) == 3

    def test_what_is_not_there_is_said_to_be_missing(self) -> None:
        files = self.opened()
        assert [*files.names()] == [*files.names("a1/parts")] == []
        assert not files.has(ROWS)
        files.put(f"{ROWS}x", [b"x"])
        for missing in (self.opened(), files):
            with pytest.raises(FileNotFoundError):
                missing.read(ROWS)
            with pytest.raises(FileNotFoundError):
                missing.size(ROWS)
            with pytest.raises(FileNotFoundError):
                missing.append(ROWS, 0, [b"x"])
        assert not files.adopt("a2/rows/history-0.zip", ROWS)
        files.remove(ROWS)
        assert [*self.opened().names()] == [f"{ROWS}x"]

    def test_names_are_listed_by_folder(self) -> None:
        files = self.opened()
        names = [JOURNAL, ROWS, "a10/rows/history-0.zip", "block0-a1"]
        for name in reversed(names):
            files.put(name, [b"x"])
        files.append(JOURNAL, 1, [b"y"])
        assert [*self.opened().names()] == names
        assert [*self.opened().names("a1/rows")] == [ROWS]
        assert [*self.opened().below("a1").names("parts")] == ["parts/00000001"]
        assert self.opened().below("a1").name == "a1"

    def test_a_file_grows_by_what_is_appended(self) -> None:
        files = self.opened()
        content = bytes(range(144))
        files.put(JOURNAL, [content[:10]])
        for first in range(10, 144, 2):  # more often than a member keeps pieces
            files.append(
                JOURNAL, first, [content[first : first + 1], content[first + 1 : first + 2]]
            )
            if first % 40 == 0:
                assert files.read(JOURNAL) == content[: first + 2]
        assert self.opened().read(JOURNAL) == content
        assert self.opened().size(JOURNAL) == 144
        assert len(self.raw()) <= 16
        with pytest.raises(ValueError, match="fewer than 145"):
            files.append(JOURNAL, 145, [b"x"])

    def test_what_is_put_is_all_of_a_file_that_had_grown(self) -> None:
        files = self.opened()
        files.put(JOURNAL, [b"begin"])
        for first in (5, 8):
            files.append(JOURNAL, first, [b"123"])
        files.append(JOURNAL, 6, [b"end"])
        assert self.opened().read(JOURNAL) == b"begin1end"
        files.append(JOURNAL, 9, [b"456"])
        files.put(JOURNAL, [b"anew"])
        assert self.opened().read(JOURNAL) == files.read(JOURNAL) == b"anew"
        assert len(self.raw()) == 1

    def test_what_was_appended_without_an_answer_is_appended_again(self) -> None:
        files = self.opened()
        files.put(JOURNAL, [b"begin"])
        files.append(JOURNAL, 5, [b" more"])
        files.append(JOURNAL, 5, [b" more and more"])
        assert self.opened().read(JOURNAL) == b"begin more and more"

    def test_rows_are_read_by_ranges_and_have_a_second_name(self) -> None:
        files = self.opened()
        files.put(ROWS, [b"0123456789"])
        assert files.adopt("a2/rows/history-0.zip", ROWS)
        files.remove(ROWS)
        left = self.opened()
        assert [*left.names()] == ["a2/rows/history-0.zip"]
        assert left.has("a2/rows/history-0.zip")
        assert left.object("a2/rows/history-0.zip").read(3, 6) == b"345"

    def test_one_file_is_removed_and_then_all(self) -> None:
        files = self.opened()
        for name in ("study/parts/00003", "study/parts/00003-a1", "study/parts/00003-a10"):
            files.put(name, [b"x"])
            files.append(name, 1, [b"y"])
        files.remove("study/parts/00003-a1")
        assert [*self.opened().names()] == ["study/parts/00003", "study/parts/00003-a10"]
        files.clear()
        assert self.raw() == {}
        files.clear()


class InObjectStoreContract(RunningFilesContract):
    """The contract, in some object store."""

    object_store: ObjectStore
    prefix: str

    def opened(self) -> RunningFiles:
        return InObjectStore(self.object_store, self.prefix)

    def raw(self) -> dict[str, bytes]:
        keys = self.object_store.list(f"{self.prefix}/")
        return {key: self.object_store.read(key, 0, self.object_store.size(key)) for key in keys}

    def test_a_reader_who_listed_a_file_before_it_was_joined_reads_all_of_it(self) -> None:
        files, reader = self.opened(), self.opened()
        files.put(JOURNAL, [b"begin"])
        files.append(JOURNAL, 5, [b" more"])
        assert reader.has(JOURNAL)
        files.put(JOURNAL, [b"begin more and more"])
        assert reader.read(JOURNAL) == b"begin more and more"

    def test_other_jobs_files_are_left_alone(self) -> None:
        other = InObjectStore(self.object_store, f"{self.prefix}-other")
        other.put("a1", [b"x"])
        self.opened().put("a1", [b"y"])
        self.opened().clear()
        assert other.read("a1") == b"x"
