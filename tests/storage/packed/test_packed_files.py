"""A packed store is an ordinary zip, and equal contents are equal bytes."""

from collections.abc import Iterator
from pathlib import Path
from zipfile import ZIP_STORED, ZipFile

import pytest
from hypothesis import given
from hypothesis import strategies as st

from jointplay.storage.errors import CorruptStore, LostObject, NotAStore
from jointplay.storage.packed import Packed, files_at, pack
from jointplay.storage.packed.ranges import InMemory

keys = st.text(st.characters(codec="utf-8", exclude_characters="\\\0"), min_size=1, max_size=30)


@given(st.dictionaries(keys, st.binary(max_size=300), max_size=20))
def test_the_standard_librarys_zipfile_reads_it(tmp_path_factory, files):
    path = tmp_path_factory.mktemp("packed") / "store.zip"
    content = b"".join(pack(files.items()))
    path.write_bytes(content)
    with ZipFile(path) as archive:
        assert archive.testzip() is None
        assert [one.filename for one in archive.infolist()] == list(files)
        assert {one.compress_type for one in archive.infolist()} <= {ZIP_STORED}
        for key, expected in files.items():
            assert archive.read(key) == expected
    found = Packed(InMemory("store.zip", content))
    assert {key: found.read(key) for key in found} == files
    assert b"".join(pack(files.items())) == content


def test_ranges_are_slices():
    files = {"a": bytes(range(200)), "b": b"", "c": b"xyz"}
    found = Packed(InMemory("store.zip", b"".join(pack(files.items()))))
    assert found.read("a", 17, 30) == bytes(range(17, 30))
    assert found.read("a", 150) == bytes(range(150, 200))
    assert found.read("a", 190, 999) == bytes(range(190, 200))  # and not the next file's
    assert found.read("b") == found.read("a", 300, 400) == b""
    assert found.entry("c").size == 3
    with pytest.raises(FileNotFoundError):
        found.read("d")


@pytest.mark.parametrize("count", [2**16 - 2, 2**16 - 1, 70_000])
def test_more_files_than_a_short_number_can_count(tmp_path, count):
    files = {f"x/c/{index}": b"%d" % index for index in range(count)}
    path = tmp_path / "store.zip"
    path.write_bytes(b"".join(pack(files.items())))
    with ZipFile(path) as archive:
        assert len(archive.namelist()) == count
        assert archive.read(f"x/c/{count - 1}") == b"%d" % (count - 1)
    found = Packed(InMemory("store.zip", path.read_bytes()))
    assert len(found.entries) == count
    assert found.read("x/c/40000") == b"40000"


def test_offsets_beyond_four_gigabytes(tmp_path):
    """The file has holes: nothing of 4 GiB is held in memory, or written."""
    large, last = bytes(2**28), b"the last one"
    entries = [(f"x/c/{index}", large) for index in range(17)] + [("zarr.json", last)]
    path = tmp_path / "store.zip"
    with path.open("wb") as file:
        for piece in pack(entries):
            if piece is large:
                file.seek(len(piece), 1)
            else:
                file.write(piece)
    with ZipFile(path) as archive:
        assert archive.read("zarr.json") == last
    found = files_at(path)
    assert found.entry("zarr.json").offset > 2**32
    assert found.read("zarr.json") == last
    assert found.read("x/c/16", 2**28 - 3) == b"\0\0\0"


def test_memory_is_that_of_one_file():
    made, held = [], []

    def entries():
        for index in range(50):
            made.append(index)
            yield f"x/c/{index}", b"x" * 1000

    for piece in pack(entries()):
        held.append(len(made))
        del piece
    assert held[:4] == [1, 1, 2, 2]


@pytest.mark.parametrize("cut", [1, 10, 100, 400])
def test_a_file_that_was_cut_off_is_refused(cut):
    content = b"".join(pack({"a": bytes(200), "b": b"x"}.items()))
    with pytest.raises(CorruptStore, match=r"store\.zip is cut off"):
        Packed(InMemory("store.zip", content[:-cut]))


def test_a_zip_of_another_program_is_refused(tmp_path: Path):
    """Its files may begin elsewhere: their local headers may be longer than ours."""
    with ZipFile(tmp_path / "store.zip", "w") as archive:
        archive.writestr("zarr.json", "{}")
    with pytest.raises(CorruptStore, match="cut off"):
        Packed(InMemory("store.zip", (tmp_path / "store.zip").read_bytes()))


def test_a_missing_object_is_no_store(tmp_path):
    with pytest.raises(NotAStore, match=r"nothing\.zip is not there"):
        files_at(tmp_path / "nothing.zip")


def flips(content: bytes) -> Iterator[tuple[int, bytes]]:
    """Give the content with one bit flipped in each of its bytes."""
    for at in range(len(content)):
        flipped = bytearray(content)
        flipped[at] ^= 1 << (at % 8)
        yield at, bytes(flipped)


def test_every_flipped_bit_is_found_before_anything_is_given_out():
    """A bit belongs to the directory, or to one file; the other files can still be read."""
    files = {"a": b"some bytes", "b/c/0": bytes(range(50)), "empty": b""}
    content = b"".join(pack(files.items()))
    for at, flipped in flips(content):
        try:
            found = Packed(InMemory("store.zip", flipped))
        except CorruptStore:
            continue
        refused = {}
        for key, expected in files.items():
            try:
                assert found.read(key) == expected, at
            except CorruptStore as error:
                refused[key] = str(error)
        ((key, sentence),) = refused.items()
        assert f"{key} of store.zip" in sentence


@pytest.mark.parametrize("start", [0, 3, 40])
def test_a_range_is_given_out_after_the_whole_file_was_checked(start):
    content = bytearray(b"".join(pack({"a": bytes(50)}.items())))
    content[content.index(bytes(50)) + 20] ^= 1
    with pytest.raises(CorruptStore, match=r"a of store\.zip has other bytes"):
        Packed(InMemory("store.zip", bytes(content))).read("a", start, start + 5)


def test_another_owners_files_are_refused():
    content = b"".join(pack({"a": b"x"}.items(), b"one job"))
    assert Packed(InMemory("rows.zip", content), b"one job").read("a") == b"x"
    with pytest.raises(CorruptStore, match=r"directory of rows\.zip"):
        Packed(InMemory("rows.zip", content), b"another job")


def test_a_file_that_is_removed_under_a_reader_is_damage_and_no_missing_key(tmp_path):
    (tmp_path / "store.zip").write_bytes(b"".join(pack({"a": b"x"}.items())))
    found = files_at(tmp_path / "store.zip")
    (tmp_path / "store.zip").unlink()
    with pytest.raises(LostObject, match=r"store\.zip was removed"):
        found.read("a")
