"""A store that is being written shows what is durable and nothing else."""

import errno
import os
import shutil
import tracemalloc
from itertools import count

import numpy as np
import pytest
import zarr
from made_up_runs import MadeUpRun, made_up_impacts, made_up_layout, packed, target
from zarr.storage import ZipStore

from jointplay.records.channel import Channel
from jointplay.records.peak import Peak
from jointplay.records.run_rows import RunRows
from jointplay.storage.errors import (
    InvalidAppend,
    InvalidLayout,
    LostObject,
    StoreExists,
    StoreSealed,
)
from jointplay.storage.packed import Running
from jointplay.storage.packed.running import ROWS
from jointplay.storage.results.layout import ResultLayout
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.results.writer import ResultWriter


@pytest.fixture
def run():
    return MadeUpRun(made_up_layout(samples=40, sections=5), made_up_impacts(30))


@pytest.fixture
def writer(tmp_path, run):
    return ResultWriter.create(tmp_path / "store", run.layout)


def test_the_watermark_is_whole_shards_and_readers_stop_there(tmp_path, run, writer):
    run.append(writer, 0.0, 0.7)
    reader = ResultReader(tmp_path / "store")
    assert (writer.samples, reader.samples) == (28, 24)
    time, channels = reader.history()
    np.testing.assert_array_equal(time, run.time[:24])
    np.testing.assert_array_equal(channels["slider7.q0"], run.samples[:24, 0])
    assert not reader.sealed
    assert not reader.complete
    assert reader.peaks() == {}
    np.testing.assert_array_equal(reader.impacts(), run.impacts[:12])
    assert len(reader.sections()[0]) == 0


def test_a_given_watermark_hides_what_lies_above_it(tmp_path, run, writer):
    run.append(writer, 0.0, 0.7)
    assert len(ResultReader(tmp_path / "store", watermark=10).history()[0]) == 10


def test_a_run_that_ended_early_keeps_what_it_computed(tmp_path, run, writer):
    run.append(writer, 0.0, 0.7)
    writer.seal(
        target(tmp_path / "store"),
        peaks={"slider7.q0": Peak(1.0, 2.0, 3.0, 4.0)},
        summary={},
        complete=False,
    )
    reader = ResultReader(tmp_path / "store.zip")
    assert (reader.sealed, reader.complete, reader.samples) == (True, False, 28)
    assert (reader.attributes["samples"], reader.attributes["sections"]) == (28, 4)
    np.testing.assert_array_equal(reader.history()[1]["slider7.q1"], run.samples[:28, 1])
    assert np.isnan(reader.peaks()["slider7.q1"].minimum)
    stock = zarr.open_group(ZipStore(tmp_path / "store.zip"), mode="r")
    assert stock["time"].shape == (28,)
    reader.verify()


def test_a_run_without_rows_seals(tmp_path, writer):
    writer.seal(target(tmp_path / "store"), peaks={}, summary={}, complete=False)
    reader = ResultReader(tmp_path / "store.zip")
    assert len(reader.history()[0]) == len(reader.sections()[0]) == len(reader.impacts()) == 0


def test_an_incomplete_run_is_not_sealed_as_complete(tmp_path, run, writer):
    run.append(writer, 0.0, 0.7)
    with pytest.raises(InvalidAppend, match="28 of 40 samples and 4 of 5 sections"):
        writer.seal(target(tmp_path / "store"), peaks=run.peaks, summary={})


def test_a_sealed_store_needs_nothing_of_its_folder(tmp_path, run, writer):
    run.append(writer, 0.0, 1.0)
    writer.checkpoint()
    early = ResultReader(Running(tmp_path / "store", target(tmp_path / "store")), writer.samples)
    assert len(early.history(["slider7.q0"])[0]) == 40
    writer.seal(target(tmp_path / "store"), peaks=run.peaks, summary={})
    shutil.rmtree(tmp_path / "store")
    ResultReader(tmp_path / "store.zip").verify()
    # who began to read the growing store reads on
    np.testing.assert_array_equal(early.history()[1]["slider7.q1"], run.samples[:, 1])
    np.testing.assert_array_equal(early.impacts(), run.impacts)


def test_rows_that_go_while_they_are_read_are_missed(tmp_path, run, writer):
    run.append(writer, 0.0, 0.7)
    reader = ResultReader(tmp_path / "store")
    shutil.rmtree(tmp_path / "store" / ROWS)
    with pytest.raises(LostObject, match="time/c/0"):
        reader.history()


def test_a_sealed_store_takes_nothing_more(tmp_path, run, writer):
    run.append(writer, 0.0, 1.0)
    writer.seal(target(tmp_path / "store"), peaks=run.peaks, summary={})
    with pytest.raises(StoreSealed):
        run.append(writer, 1.0, 1.0)
    with pytest.raises(StoreSealed):
        writer.checkpoint()
    with pytest.raises(StoreSealed):
        writer.seal(target(tmp_path / "store"), peaks=run.peaks, summary={})


def test_a_store_is_written_once(tmp_path, run, writer):
    with pytest.raises(StoreExists, match="choose another folder"):
        ResultWriter.create(tmp_path / "store", run.layout)


@pytest.mark.parametrize("written", [0, 1, 2, 6])
def test_a_full_disk_loses_no_row_that_was_taken(tmp_path, run, writer, monkeypatch, written):
    run.append(writer, 0.0, 0.2)
    write, calls = os.fsync, count()

    def write_until_full(descriptor):
        if next(calls) >= written:
            raise OSError(errno.ENOSPC, "No space left on device")
        write(descriptor)

    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", write_until_full)
        with pytest.raises(OSError, match="No space left"):
            run.append(writer, 0.2, 0.9)
    kept = writer.samples
    assert kept >= 8
    writer.seal(
        target(tmp_path / "store"), peaks=run.peaks, summary={}, complete=False
    )  # somebody made room
    reader = ResultReader(tmp_path / "store.zip")
    reader.verify()
    np.testing.assert_array_equal(reader.history()[1]["slider7.q1"], run.samples[:kept, 1])


@pytest.mark.parametrize(
    ("first", "rows", "width", "complaint"),
    [
        (1, 3, 2, "the next rows are sample 0"),
        (0, 3, 1, r"samples must have shape \(3, 2\)"),
        (0, 41, 2, "more than the 40"),
    ],
)
def test_rows_that_do_not_fit_are_refused_and_not_taken(writer, first, rows, width, complaint):
    samples = np.zeros((rows, width))
    with pytest.raises(InvalidAppend, match=complaint):
        writer.append(RunRows(first_sample=first, sample_time=np.zeros(rows), samples=samples))
    assert writer.samples == 0


def test_impacts_need_their_fields(writer):
    impacts = np.zeros(2, [("joint", "i4")])
    with pytest.raises(InvalidAppend, match="approach_rate"):
        writer.append(RunRows(impacts=impacts))


@pytest.mark.parametrize("summary", [{"seconds": float("nan")}, {"seconds": {1, 2}}])
def test_a_summary_that_json_cannot_carry_is_refused(tmp_path, run, writer, summary):
    run.append(writer, 0.0, 1.0)
    with pytest.raises(InvalidAppend, match="finite JSON"):
        writer.seal(target(tmp_path / "store"), peaks=run.peaks, summary=summary)


def test_peaks_of_unknown_channels_are_refused(tmp_path, run, writer):
    run.append(writer, 0.0, 1.0)
    with pytest.raises(InvalidAppend, match=r"slider8\.x"):
        writer.seal(
            target(tmp_path / "store"), peaks={"slider8.x": Peak(0.0, 0.0, 0.0, 0.0)}, summary={}
        )


@pytest.mark.parametrize(
    "name", ["", ".hidden", "..", "a/b", "a b", "time", "peaks", "x" * 65, "ä", "zarr.json", "a\n"]
)
def test_names_that_would_leave_their_place_are_refused(name):
    with pytest.raises(InvalidLayout, match="cannot name"):
        ResultLayout((Channel(name, "m", ""),), 1, 0, ())


def test_a_name_occurs_once():
    with pytest.raises(InvalidLayout, match="occurs twice"):
        ResultLayout((Channel("x", "m", ""), Channel("x", "s", "")), 1, 0, ())


def test_a_million_impacts_stay_flat_in_memory(tmp_path):
    layout = made_up_layout(samples=0, sections=0, partition=ResultLayout((), 0, 0, ()).partition)
    rows = RunRows(impacts=made_up_impacts(10_000))
    tracemalloc.start()
    try:
        writer = ResultWriter.create(tmp_path / "store", layout)
        for _ in range(100):
            writer.append(rows)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert writer.impacts == 1_000_000
    # the bound on one table's buffer, and as much again for a shard on its way to the disk
    assert peak < 2 * layout.partition.buffer_bytes


def test_a_table_that_ends_with_a_whole_shard_is_finished_by_sealing(tmp_path):
    """36 samples are three whole shards, 12 sections one: neither last one is written before."""
    run = MadeUpRun(made_up_layout(samples=36, sections=12), made_up_impacts(3))
    writer = ResultWriter.create(tmp_path / "store", run.layout)
    run.append(writer, 0.0, 1.0)
    durable = ResultReader(tmp_path / "store").samples
    assert (writer.samples, durable, writer.sections) == (36, 24, 12)
    token = writer.checkpoint()
    resumed = ResultWriter.resume(
        tmp_path / "again", run.layout, token, taken_over_from=tmp_path / "store"
    )
    for name, one in (("store", writer), ("again", resumed)):
        one.seal(target(tmp_path / name), peaks=run.peaks, summary={})
        reader = ResultReader(packed(tmp_path / name))
        reader.verify()
        np.testing.assert_array_equal(reader.history()[0], run.time)
        np.testing.assert_array_equal(reader.sections()[0], run.section_time)
