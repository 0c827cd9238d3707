"""Extremes of windows of a history: as if every sample had been looked at."""

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
import zarr
from hypothesis import given
from hypothesis import strategies as st
from zarr.storage import ZipStore

from jointplay.storage.errors import LostObject
from jointplay.storage.packed.running import Running, digest_in
from jointplay.storage.results.layout import Partition
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.results.writer import ResultWriter
from tests.storage.results.made_up_runs import (
    MEMORY,
    MadeUpRun,
    made_up_impacts,
    made_up_layout,
    packed,
    target,
)

# buckets of 4, 64 and 1024 samples; files of 32 buckets
SMALL = Partition(
    chunk_rows=16, shard_chunks=4, buffer_bytes=2**20, pyramid_above=100, bucket=4, level_rows=32
)
SAMPLES = 16_411


@pytest.fixture(scope="module")
def run():
    return MadeUpRun(made_up_layout(SAMPLES, 0, partition=SMALL), made_up_impacts(0))


@pytest.fixture(scope="module")
def sealed(run):
    with TemporaryDirectory(dir=MEMORY) as folder:
        yield run.write(Path(folder) / "store")


def expected(values, first, last, begins):
    ends = [*begins[1:], last]
    return [[values[b:e].min(), values[b:e].max()] for b, e in zip(begins, ends, strict=True)]


def check(run, reader, first, last, points):
    times, found = reader.extremes(["slider7.q1"], first, last, points)
    assert 1 <= len(times) <= points
    begins = np.searchsorted(run.time, times[:, 0])
    assert begins[0] == first
    np.testing.assert_array_equal(times, expected(run.time, first, last, begins))
    pairs = expected(run.samples[:, 1], first, last, begins)
    np.testing.assert_array_equal(found["slider7.q1"], pairs)
    return len(times)


@given(st.integers(0, SAMPLES - 1), st.integers(1, SAMPLES), st.integers(1, 3000))
def test_extremes_are_those_of_all_samples(run, sealed, first, last, points):
    first, last = min(first, last - 1), max(first + 1, last)
    check(run, ResultReader(sealed), first, last, points)


@pytest.mark.parametrize("points", [2, 100, 1000, 4000])
def test_most_of_the_points_asked_for_are_used(run, sealed, points):
    assert check(run, ResultReader(sealed), 0, SAMPLES, points) >= 0.7 * min(points, SAMPLES) - 1


@pytest.fixture
def memory():
    """A folder whose disk costs nothing: there are thousands of tiny files."""
    with TemporaryDirectory(dir=MEMORY) as folder:
        yield Path(folder)


@pytest.mark.parametrize("stop", [0.0001, 0.013, 0.5, 0.77])
def test_a_growing_history_has_them_too(memory, run, stop):
    writer = ResultWriter.create(memory / "store", run.layout)
    run.append(writer, 0.0, stop / 3)
    run.append(writer, stop / 3, stop)
    writer.checkpoint()
    reader = ResultReader(memory / "store", writer.samples)
    for points in (1, 7, 300):
        check(run, reader, 0, writer.samples, points)


def test_while_it_grows_a_file_has_chunks_of_four_places(memory, run):
    writer = ResultWriter.create(memory / "store", run.layout)
    run.append(writer, 0.0, 0.4)
    found = sorted(path.name for path in (memory / "store" / "rows").glob("pyramid-4-*"))
    whole = writer.samples // (4 * 32 * 4)  # samples of a bucket, buckets of a chunk, chunks
    assert found == sorted(f"pyramid-4-{4 * k}-{4 * k + 3}.zip" for k in range(whole))
    growing = Running(memory / "store", digest=digest_in(run.layout.attributes))
    pattern = "pyramid/4/extremes/c/{}/0"
    assert growing.shards(pattern) == 4 * whole
    (memory / "store" / "rows" / "pyramid-4-4-7.zip").unlink()
    with pytest.raises(LostObject, match="pyramid/4/extremes/c/4/0"):
        growing.shards(pattern)


@pytest.mark.parametrize("cuts", [[0.4], [0.01, 0.3, 0.31, 0.99]])
def test_its_bytes_do_not_depend_on_slices_or_interruptions(memory, run, sealed, cuts):
    writer = ResultWriter.create(memory / "0", run.layout)
    reached = 0.0
    for attempt, stop in enumerate(cuts, 1):
        run.append(writer, reached, stop)
        reached = stop
        token = writer.checkpoint()
        before, after = memory / str(attempt - 1), memory / str(attempt)
        writer = ResultWriter.resume(after, run.layout, token, taken_over_from=before)
    run.append(writer, reached, 1.0)
    last = memory / str(len(cuts))
    writer.seal(target(last), peaks=run.peaks, summary={"steps": 3})
    assert packed(last).read_bytes() == sealed.read_bytes()


def test_a_level_is_an_array_that_nobody_is_told_of(run, sealed):
    store = ZipStore(sealed)
    assert "pyramid" not in dict(zarr.open_group(store, mode="r").members())
    for size in (4, 64, 1024):
        level = zarr.open_array(store, path=f"pyramid/{size}/extremes", mode="r")
        buckets = -(-SAMPLES // size)
        assert level.shape == (buckets, 2 * (2 + 1))
        begins = np.arange(buckets) * size
        pairs = expected(run.samples[:, 1], 0, SAMPLES, begins)
        np.testing.assert_array_equal(level[:, 2:4], pairs)


def test_a_short_history_has_none(tmp_path):
    run = MadeUpRun(made_up_layout(100, 0, partition=SMALL), made_up_impacts(0))
    writer = ResultWriter.create(tmp_path / "store", run.layout)
    run.append(writer, 0.0, 1.0)
    writer.seal(target(tmp_path / "store"), peaks=run.peaks, summary={})
    reader = ResultReader(tmp_path / "store.zip")
    assert not any(key.startswith("pyramid") for key in reader.files)
    check(run, reader, 3, 97, 10)


@given(st.floats(-0.1, 2.1))
def test_times_are_found_between_samples_and_at_them(run, sealed, time):
    reader = ResultReader(sealed)
    for asked in (time, float(run.time[int(max(time, 0.0) * 7000)])):
        first, last = reader.between(asked, asked)
        assert first == np.searchsorted(run.time, asked, "left")
        assert last == max(np.searchsorted(run.time, asked, "right"), first)
