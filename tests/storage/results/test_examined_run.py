"""Stores of runs that others sealed: all that the writer makes are taken, and no others."""

import json
import tracemalloc
from itertools import product
from zipfile import ZipFile

import numpy as np
import pytest
from made_up_runs import (
    PLAIN_FILES,
    SMALL_FILES,
    MadeUpRun,
    made_up_impacts,
    made_up_layout,
)

from jointplay.storage.errors import CorruptStore
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.packed import pack
from jointplay.storage.results import shards
from jointplay.storage.results.examined_run import examined_run
from jointplay.storage.results.layout import MANIFEST, Partition
from jointplay.storage.results.manifest import listed
from jointplay.storage.results.writer import ResultWriter
from tests.stores import target

PYRAMID = Partition(chunk_rows=64, shard_chunks=2, pyramid_above=100, bucket=4, level_rows=16)


def sealed(run: MadeUpRun, folder, part: float = 1.0) -> StoredObject:
    """Store a run, or the first part of it."""
    writer = ResultWriter.create(folder, run.layout)
    run.append(writer, 0.0, part)
    writer.seal(target(folder), peaks=run.peaks, summary={"steps": 3}, complete=part == 1.0)
    return target(folder)


@pytest.mark.parametrize(
    ("samples", "sections", "partition", "steps"),
    [
        *product((0, 1, 30), (0, 3), (SMALL_FILES, PLAIN_FILES), ((), ("a", "b"))),
        *product((1000,), (7,), (PYRAMID, Partition()), ((), ("a", "b", "c"))),
    ],
)
@pytest.mark.parametrize("part", [1.0, 0.4, 0.0])
def test_all_that_can_be_sealed_is_taken(tmp_path, samples, sections, partition, steps, part):
    layout = made_up_layout(samples, sections, partition=partition, steps=steps)
    run = MadeUpRun(layout, made_up_impacts(samples // 3))
    complete = part == 1.0 or (samples, sections) == (0, 0)
    store = sealed(run, tmp_path / "store", part)
    for same in (True, False):
        assert examined_run(store, layout, same=same)["samples"] <= samples
    assert complete or not examined_run(store, layout, same=True)["complete"]


@pytest.fixture
def run():
    layout = made_up_layout(300, 3, partition=PYRAMID, steps=("a", "b"))
    return MadeUpRun(layout, made_up_impacts(40))


BOMB = np.zeros(2**24)
"""A chunk of which little is stored, and that takes 128 MB."""


def changed(document, **values):
    return json.dumps(json.loads(document) | values, separators=(",", ":")).encode()


def lying() -> bytes:
    """A shard whose chunks say that they have 2 GB of values."""
    chunk = shards.compress(np.zeros(64))
    lie = chunk[:4] + (2**31 - 1).to_bytes(4, "little") + chunk[8:]
    return shards.pack([lie] * 2)


ATTACKS = {
    "a header that lies": lambda files: {"slider7.q0/c/0": lying()},
    "a bomb": lambda files: {"slider7.q0/c/0": shards.pack([shards.compress(BOMB)] * 2)},
    "no chunk in a file": lambda files: {"slider7.q0/c/0": shards.pack([b"", b""])},
    "a shard without an index": lambda files: {"slider7.q0/c/0": b"\0" * 36},
    "a chunk outside": lambda files: {"slider7.q0/c/9": files["slider7.q0/c/0"]},
    "a chunk of no array": lambda files: {"other/c/0": files["slider7.q0/c/0"]},
    "another shape": lambda files: {
        "slider7.q0/zarr.json": changed(files["slider7.q0/zarr.json"], shape=[299])
    },
    "other words": lambda files: {
        "slider7.q0/zarr.json": changed(files["slider7.q0/zarr.json"], attributes={"units": "km"})
    },
    "an array more": lambda files: {"other/zarr.json": files["slider7.q0/zarr.json"]},
    "a file more": lambda files: {"../outside": b"x"},
    "no attributes": lambda files: {"zarr.json": b'{"attributes": 7}'},
    "no object": lambda files: {"zarr.json": b"[" * 100_000},
    "rows without end": lambda files: {
        "zarr.json": files["zarr.json"].replace(b'"impacts":40', b'"impacts":40000000000000')
    },
    "no number of rows": lambda files: {
        "zarr.json": files["zarr.json"].replace(b'"samples":300', b'"samples":"300"')
    },
    "steps without end": lambda files: {
        "steps/rows/zarr.json": changed(files["steps/rows/zarr.json"], shape=[10**15, 2])
    },
}


@pytest.mark.parametrize("attack", ATTACKS)
@pytest.mark.parametrize("manifest", [True, False])
def test_what_the_writer_does_not_make_is_refused(tmp_path, run, attack, manifest):
    store = sealed(run, tmp_path / "store")
    path = target(tmp_path / "store").key
    with ZipFile(tmp_path / path) as archive:
        found = {name: archive.read(name) for name in archive.namelist()}
    own = found.pop(MANIFEST)
    found |= ATTACKS[attack](found)
    entries = listed(found.items()) if manifest else [*found.items(), (MANIFEST, own)]
    (tmp_path / path).write_bytes(b"".join(pack(entries)))
    with pytest.raises(CorruptStore):
        examined_run(store, run.layout, same=True)


def test_no_file_is_there_twice(tmp_path, run):
    """Programs that read zips take the first or the last one."""
    store = sealed(run, tmp_path / "store")
    path = tmp_path / target(tmp_path / "store").key
    with ZipFile(path) as archive:
        found = [(name, archive.read(name)) for name in archive.namelist()]
    path.write_bytes(b"".join(pack([("slider7.q0/c/0", b"a lie"), *found])))
    with pytest.raises(CorruptStore, match="is not behind the file before it"):
        examined_run(store, run.layout, same=True)


@pytest.mark.parametrize(
    "lost", ["slider7.q0/c/1", "time/zarr.json", "peaks/minimum/c/0", MANIFEST]
)
def test_every_file_must_be_there(tmp_path, run, lost):
    store = sealed(run, tmp_path / "store")
    path = tmp_path / target(tmp_path / "store").key
    with ZipFile(path) as archive:
        found = {name: archive.read(name) for name in archive.namelist() if name != lost}
    found.pop(MANIFEST, None)
    entries = listed(found.items()) if lost != MANIFEST else found.items()
    path.write_bytes(b"".join(pack(entries)))
    with pytest.raises(CorruptStore, match=r"lacks 1 files|lacks files"):
        examined_run(store, run.layout, same=True)


def test_numbers_of_the_document_may_differ_in_their_last_bits_alone(tmp_path):
    """The service may have another class of processors than the worker."""
    layouts = [
        made_up_layout(30, 3, attributes={"period": period, "places": [{"x": period}]})
        for period in (0.1, np.nextafter(0.1, 1.0), 0.1001)
    ]
    store = sealed(MadeUpRun(layouts[0], made_up_impacts(4)), tmp_path / "store")
    examined_run(store, layouts[1], same=True)
    with pytest.raises(CorruptStore, match="the attribute p"):
        examined_run(store, layouts[2], same=True)


def test_memory_is_bounded_by_the_largest_file(tmp_path):
    layout = made_up_layout(20_000, 3, channels=40, partition=Partition())
    store = sealed(MadeUpRun(layout, made_up_impacts(4)), tmp_path / "store")
    whole = store.size()
    assert whole > 6e6
    tracemalloc.start()
    try:
        examined_run(store, layout, same=True)
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert most < whole / 3
