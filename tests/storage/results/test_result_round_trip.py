"""Rows that were appended are what is read, by our reader and by stock zarr."""

import json
import tempfile
from itertools import pairwise
from pathlib import Path
from zipfile import ZipFile

import numpy as np
import pytest
import zarr
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from made_up_runs import (
    MEMORY,
    PLAIN_FILES,
    SMALL_FILES,
    MadeUpRun,
    made_up_impacts,
    made_up_layout,
    target,
)
from zarr.storage import ZipStore

from jointplay.storage.errors import NotAStore, UnknownChannel
from jointplay.storage.packed import pack
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.results.writer import ResultWriter

json_documents = st.dictionaries(
    st.text(max_size=10),
    st.recursive(
        st.none()
        | st.booleans()
        | st.integers(-(2**63), 2**63)
        | st.text(max_size=10)
        | st.floats(allow_nan=False, allow_infinity=False),
        lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner),
        max_leaves=8,
    ),
    max_size=4,
)


@pytest.fixture(scope="module", params=[SMALL_FILES, PLAIN_FILES], ids=["sharded", "plain"])
def run(request):
    layout = made_up_layout(samples=43, sections=7, partition=request.param)
    return MadeUpRun(layout, made_up_impacts(30))


@pytest.fixture(scope="module")
def store(run):
    with tempfile.TemporaryDirectory(dir=MEMORY) as folder:
        yield run.write(Path(folder, "store"))


def test_values_come_back_bit_for_bit(store, run):
    reader = ResultReader(store)
    time, channels = reader.history()
    np.testing.assert_array_equal(time, run.time)
    np.testing.assert_array_equal(np.column_stack(list(channels.values())), run.samples)
    section_time, sections = reader.sections()
    np.testing.assert_array_equal(section_time, run.section_time)
    np.testing.assert_array_equal(np.column_stack(list(sections.values())), run.sections)
    np.testing.assert_array_equal(reader.impacts(), run.impacts)
    assert reader.peaks() == run.peaks
    assert reader.channels == run.layout.channels
    assert reader.joints == ("A", "B")
    assert (reader.sealed, reader.complete, reader.samples) == (True, True, 43)


@settings(max_examples=30, deadline=None)
@given(
    samples=arrays.arrays(
        np.float64, st.tuples(st.integers(0, 30), st.integers(1, 3)), elements=st.floats(width=64)
    )
)
def test_every_double_survives(samples):
    rows, channels = samples.shape
    run = MadeUpRun(made_up_layout(rows, 0, channels), made_up_impacts(0))
    run.samples = samples
    with tempfile.TemporaryDirectory(dir=MEMORY) as folder:
        _, found = ResultReader(run.write(Path(folder, "store"))).history()
    assert np.column_stack(list(found.values())).tobytes() == samples.tobytes()


@settings(max_examples=30, deadline=None)
@given(attributes=json_documents, summary=json_documents)
def test_attributes_and_summary_come_back(attributes, summary):
    layout = made_up_layout(0, 0, attributes={"job": attributes})
    with tempfile.TemporaryDirectory(dir=MEMORY) as folder:
        writer = ResultWriter.create(Path(folder, "store"), layout)
        writer.seal(target(Path(folder, "store")), peaks={}, summary=summary)
        found = ResultReader(Path(folder, "store.zip")).attributes
    assert found["job"] == attributes
    assert found["summary"] == summary


@pytest.mark.parametrize("window", [(0, 5), (3, 9), (11, 13), (40, 43), (40, 99), (43, 50), (9, 3)])
def test_a_window_is_a_slice_of_the_whole(store, run, window):
    time, channels = ResultReader(store).history(["slider7.q1"], *window)
    np.testing.assert_array_equal(time, run.time[slice(*window)])
    np.testing.assert_array_equal(channels["slider7.q1"], run.samples[slice(*window), 1])


def test_blocks_join_up_to_the_window_and_are_no_longer_than_a_chunk(store, run):
    blocks = [time for time, _ in ResultReader(store).blocks(["slider7.q0"], 3, 41)]
    np.testing.assert_array_equal(np.concatenate(blocks), run.time[3:41])
    assert max(map(len, blocks)) == 4


def test_times_find_their_samples(store, run):
    reader = ResultReader(store)
    moments = sorted([-1.0, 3.0, *run.time, *(run.time + 1e-3)])
    for start, stop in pairwise(moments):
        inside = np.flatnonzero((run.time >= start) & (run.time <= stop))
        first, last = reader.between(start, stop)
        np.testing.assert_array_equal(np.arange(first, last), inside)
    assert reader.between(None, None) == (0, 43)
    assert reader.between(1.0, 0.5) == (reader.between(1.0, None)[0],) * 2


def test_stock_zarr_sees_names_units_and_values(store, run):
    root = zarr.open_group(ZipStore(store), mode="r")
    assert sorted(root.array_keys()) == ["slider7.q0", "slider7.q1", "time"]
    assert sorted(root.group_keys()) == ["impacts", "peaks", "poincare"]
    channel = root["slider7.q1"]
    assert channel.attrs.asdict() == {"units": "m", "long_name": "coordinate 1"}
    assert channel.metadata.dimension_names == ("sample",)
    assert np.isnan(channel.fill_value)
    np.testing.assert_array_equal(channel[:], run.samples[:, 1])
    np.testing.assert_array_equal(root["poincare/slider7.q0"][:], run.sections[:, 0])
    assert root["poincare/time"].metadata.dimension_names == ("section",)
    assert root["impacts/joint"].attrs["flag_meanings"] == "A B"
    np.testing.assert_array_equal(root["impacts/peak_force"][:], run.impacts["peak_force"])
    assert root["peaks"].attrs["channels"] == ["slider7.q0", "slider7.q1"]
    assert root["peaks/maximum"][1] == run.peaks["slider7.q1"].maximum
    assert root.attrs["job"] == {"kind": "simulate"}


@pytest.mark.parametrize("group", ["", "poincare", "impacts", "peaks"])
def test_every_group_lists_its_arrays_without_listing_a_folder(store, group):
    begin = f"{group}/" if group else ""
    with ZipFile(store) as archive:
        on_disk = {
            name.removeprefix(begin).removesuffix("/zarr.json"): json.loads(archive.read(name))
            for name in archive.namelist()
            if name.startswith(begin) and name.endswith("zarr.json")
        }
    below = on_disk.pop("zarr.json")["consolidated_metadata"]["metadata"]
    assert below.keys() == on_disk.keys()
    for name, entry in below.items():
        if entry["node_type"] == "array":
            assert entry == on_disk[name]


def test_stock_zarr_agrees_on_what_the_metadata_means(store):
    """Zarr writes the same document for the array as it understood ours."""
    with ZipFile(store) as archive:
        documents = {
            name.removesuffix("/zarr.json"): json.loads(archive.read(name))
            for name in archive.namelist()
            if name.endswith("/zarr.json")
        }
    for path, ours in documents.items():
        if ours["node_type"] == "array":
            understood = zarr.open_array(ZipStore(store), path=path, mode="r").metadata.to_dict()
            for member in ("shape", "data_type", "chunk_grid", "codecs", "dimension_names"):
                # through JSON, which knows no tuples
                assert json.loads(json.dumps(understood[member])) == ours[member]


def test_an_unknown_channel_is_refused_with_those_there_are(store):
    with pytest.raises(UnknownChannel, match=r"slider7\.q0, slider7\.q1"):
        ResultReader(store).history(["slider7.z"])
    with pytest.raises(UnknownChannel):
        ResultReader(store).history(["time"])


@pytest.mark.parametrize("content", [None, b"", b"{}", b"[]", b'{"zarr_format": 2}'])
def test_what_holds_no_store_is_refused(tmp_path, content):
    with pytest.raises(NotAStore):
        ResultReader(tmp_path)
    if content is not None:
        (tmp_path / "store.zip").write_bytes(b"".join(pack([("zarr.json", content)])))
    with pytest.raises(NotAStore):
        ResultReader(tmp_path / "store.zip")


def test_a_foreign_group_is_refused(tmp_path):
    document = b'{"attributes": {"result_schema": 99}, "consolidated_metadata": {"metadata": {}}}'
    (tmp_path / "store.zip").write_bytes(b"".join(pack([("zarr.json", document)])))
    with pytest.raises(NotAStore, match="this version reads 1"):
        ResultReader(tmp_path / "store.zip")
