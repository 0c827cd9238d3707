"""Points that are a map over two axes: as stock clients see them, sealed and while it is filled."""

import asyncio
import json
from dataclasses import replace

import numpy as np
import pytest
import xarray
from made_up_studies import MadeUpStudy, made_up_layout, made_up_map
from zarr.core.buffer import default_buffer_prototype
from zarr.storage import MemoryStore

from jointplay.records.coarse_to_fine import coarse_to_fine
from jointplay.storage.errors import CorruptStore, InvalidAppend, InvalidLayout
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.object_stores.folder import Folder
from jointplay.storage.packed import Running, pack
from jointplay.storage.results import manifest
from jointplay.storage.studies.block import StudyBlock
from jointplay.storage.studies.cut import bands, chunk_shape, chunks
from jointplay.storage.studies.examined_part import require_part
from jointplay.storage.studies.examined_study import examined_study
from jointplay.storage.studies.live import LiveStudy
from jointplay.storage.studies.reader import StudyReader
from jointplay.storage.studies.store import create
from tests.stores import files_of

ROWS, COLUMNS = 3, 300
HALF = 512  # points of the first block: it ends within a row


@pytest.fixture
def study():
    points = ROWS * COLUMNS
    return MadeUpStudy(made_up_map(ROWS, COLUMNS, blocks=((0, HALF), (HALF, points - HALF))))


def chunks_of(growing):
    """Yield the key of every chunk of a growing study that no file has."""
    root = json.loads(growing.document("zarr.json"))
    for name, node in root["consolidated_metadata"]["metadata"].items():
        if node["node_type"] != "array":
            continue
        chunk = node["chunk_grid"]["configuration"]["chunk_shape"]
        grid = [-(-size // step) for size, step in zip(node["shape"], chunk, strict=True)]
        keys = ("/".join([name, "c", *map(str, index)]) for index in np.ndindex(*grid))
        yield from (key for key in keys if not growing.in_file(key))


def test_a_growing_map_has_the_bytes_of_a_sealed_one(tmp_path, study):
    create(tmp_path, study.layout)
    for index in (1, 0):
        study.write_block(tmp_path, index)
    growing = LiveStudy(StudyReader(Running(tmp_path)), study.layout.outputs)
    sealed = StudyReader(study.write(tmp_path.with_name("whole"))).files
    keys = list(chunks_of(growing))
    assert {"status/c/0/1", "peaks/maximum/c/0/2/0", "y/c/0", "statistics/x/c/0"} <= {*keys}
    for key in keys:
        assert growing.chunk(key) == sealed.read(key)
        document = f"{key.rpartition('/c/')[0]}/zarr.json"
        assert growing.document(document) == sealed.read(document)
    assert growing.chunk("status/c/0/2") is growing.chunk("status/c/0") is None


def opened(growing, group):
    """Return a group of a growing study as xarray reads it from a service."""

    async def put(key, content):
        await files.set(key, default_buffer_prototype().buffer.from_bytes(content))

    files = MemoryStore()
    for name in ("", "indicators/", "peaks/", "statistics/"):
        asyncio.run(put(f"{name}zarr.json", growing.document(f"{name}zarr.json")))
    for key in chunks_of(growing):
        asyncio.run(put(key, growing.chunk(key)))
    return xarray.open_zarr(files, group=group, chunks=None)


def test_what_has_one_number_a_point_lies_over_both_axes(tmp_path, study):
    create(tmp_path, study.layout)
    study.write_block(tmp_path, 0)
    y, x = (values for _, values in study.layout.coordinates.values())
    for reader in (StudyReader(tmp_path), StudyReader(study.write(tmp_path.with_name("whole")))):
        assert reader.shape == (ROWS, COLUMNS)
        known = study.layout.points if reader.sealed else HALF
        growing = LiveStudy(reader, study.layout.outputs)
        for group in (None, "indicators", "peaks"):
            found = opened(growing, group)
            np.testing.assert_array_equal(found["y"], y)
            np.testing.assert_array_equal(found["x"], x)
            assert found["x"].attrs["parameter"] == "clearance"
            assert found["x"].attrs["units"] == "m"
        assert found["maximum"].dims == ("y", "x", "channel")
        status = opened(growing, None)["status"]
        assert (status.dims, status.shape) == (("y", "x"), (ROWS, COLUMNS))
        order = coarse_to_fine((ROWS, COLUMNS))
        np.testing.assert_array_equal(status.values.ravel()[order] > 0, np.arange(900) < known)
        steps = opened(growing, "statistics")["steps"].sel(y=0.1, x=3.0, method="nearest")
        last = study.steps[-1] if reader.sealed else np.nan
        np.testing.assert_array_equal(steps, last)


@pytest.mark.parametrize("shape", [(3, 4), (5, 3), (15, 1), (1, 3, 5)])
def test_points_that_are_no_map_are_refused(shape):
    with pytest.raises(InvalidLayout, match=r"15 points are no map of the shape"):
        replace(made_up_map(3, 5), shape=shape)
    with pytest.raises(InvalidLayout, match="no map"):
        replace(made_up_layout(points=15), shape=(3, 5))


def test_no_number_of_a_point_is_named_as_an_axis(tmp_path, study):
    create(tmp_path, study.layout)
    end = study.end(0)
    (first, *_) = study.slices(0)
    piece = replace(first, rows=(), ended=(replace(end, statistics={"x": 1.0}),))
    with pytest.raises(InvalidAppend, match="'x' is an axis"):
        StudyBlock(tmp_path, study.layout, 0).take(piece)


def test_a_map_is_another_study_than_its_points_alone():
    flat = replace(made_up_map(3, 5), shape=())
    assert flat.shape == (15,)
    assert flat.digest != made_up_map(3, 5).digest


def test_a_map_that_was_handed_in_is_taken_for_what_the_job_gives_and_no_other(tmp_path, study):
    store, layout = study.write(tmp_path / "whole"), study.layout
    for index in range(len(layout.blocks)):
        files = Running(tmp_path / "whole", digest=layout.digest)
        require_part(files, layout, index, same=False)
    for same in (True, False):
        examined_study(StoredObject(Folder(str(tmp_path)), store.name), layout, same=same)
    files = {name: content for name, content in files_of(store).items() if name != "MANIFEST.json"}
    files["statistics/x/c/0"] = files["peaks/x/c/0"] = files["statistics/y/c/0"]
    moved = StoredObject(Folder(str(tmp_path)), "moved.zip")
    moved.put(pack(manifest.listed(files.items())))
    with pytest.raises(CorruptStore, match="statistics/x"):
        examined_study(moved, layout, same=True)


@pytest.mark.parametrize(
    "shape", [(1, 1), (3, 300), (300, 3), (70_000, 1), (2, 40_000), (513, 515)]
)
@pytest.mark.parametrize("width", [0, 3])
def test_every_point_is_in_one_chunk_and_narrow_maps_have_few(shape, width):
    layout = made_up_map(*shape)
    numbers = np.arange(layout.points)
    height, across = chunk_shape(layout, width)
    laid = np.full(shape, -1)
    found = list(bands(layout, width))
    for band in found:
        own = np.concatenate([numbers[run] for run in band.points])
        for index, chunk in chunks(layout, band, own, width):
            row, column = (int(one) for one in index.split("/"))
            at = row * height, column * across
            laid[at[0] : at[0] + len(chunk), at[1] : at[1] + chunk.shape[1]] = chunk
    np.testing.assert_array_equal(laid.ravel()[layout.order], numbers)
    assert len(found) <= 1 + 4 * layout.points * max(width, 1) / 256**2
