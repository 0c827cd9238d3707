"""Bytes on the disk depend on the rows alone: not on slices, kills or resumptions."""

import os
import shutil
import tempfile
import tracemalloc
from itertools import count, pairwise
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from made_up_runs import (
    MEMORY,
    PLAIN_FILES,
    SMALL_FILES,
    MadeUpRun,
    made_up_impacts,
    made_up_layout,
    packed,
    target,
)

from jointplay.storage.errors import CheckpointMismatch, CorruptStore, StoreExists
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.object_stores.folder import Folder
from jointplay.storage.results.layout import Partition
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.results.writer import ResultWriter

# where a part of the run ends, and what happens there: nothing, a checkpoint, or a checkpoint and
# later a kill that loses what was appended since
event = st.tuples(st.floats(0.0, 1.0), st.sampled_from(["on", "checkpoint", "kill"]))

runs = st.builds(
    lambda samples, sections, impacts, partition: MadeUpRun(
        made_up_layout(samples, sections, partition=partition), made_up_impacts(impacts)
    ),
    samples=st.integers(0, 40),
    sections=st.integers(0, 20),
    impacts=st.integers(0, 40),
    partition=st.sampled_from([SMALL_FILES, PLAIN_FILES]),
)


@settings(max_examples=100, deadline=None)
@given(run=runs, events=st.lists(event, max_size=8))
def test_any_slicing_and_any_kill_gives_the_files_of_an_undisturbed_run(run, events):
    with tempfile.TemporaryDirectory(dir=MEMORY) as folder:
        undisturbed = run.write(Path(folder, "undisturbed"))
        attempts = [Path(folder, "a1")]
        writer = ResultWriter.create(attempts[-1], run.layout)
        reached = 0.0
        for stop, happening in sorted(events):
            run.append(writer, reached, stop)
            reached = stop
            if happening == "on":
                continue
            checkpoint = writer.checkpoint()
            if happening == "kill":
                run.append(writer, reached, (1.0 + reached) / 2)  # these rows are lost
                attempts.append(Path(folder, f"a{len(attempts) + 1}"))
                writer = ResultWriter.resume(
                    attempts[-1], run.layout, checkpoint, taken_over_from=attempts[-2]
                )
        run.append(writer, reached, 1.0)
        for attempt in attempts[:-1]:
            shutil.rmtree(attempt)
        writer.seal(target(attempts[-1]), peaks=run.peaks, summary={"steps": 3})
        assert packed(attempts[-1]).read_bytes() == undisturbed.read_bytes()
        ResultReader(undisturbed).verify()


def sealed(writer, folder, run):
    writer.seal(target(folder), peaks=run.peaks, summary={"steps": 3})
    return packed(folder).read_bytes()


def undisturbed(run, folder):
    return run.write(folder / "undisturbed").read_bytes()


class Killed(Exception):
    """Stands for the end of the process."""


@pytest.mark.parametrize("survived", range(3))
def test_a_kill_amid_the_shards_leaves_the_checkpoint_valid(tmp_path, monkeypatch, survived):
    run = MadeUpRun(made_up_layout(samples=40, sections=2), made_up_impacts(40))
    writer = ResultWriter.create(tmp_path / "a1", run.layout)
    run.append(writer, 0.0, 0.4)
    checkpoint = writer.checkpoint()
    replace, calls = os.replace, count()

    def replace_until_killed(source, target):
        if next(calls) == survived:
            raise Killed
        replace(source, target)

    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", replace_until_killed)
        with pytest.raises(Killed):
            run.append(writer, 0.4, 1.0)
    resumed = ResultWriter.resume(
        tmp_path / "a2", run.layout, checkpoint, taken_over_from=tmp_path / "a1"
    )
    run.append(resumed, 0.4, 1.0)
    assert sealed(resumed, tmp_path / "a2", run) == undisturbed(run, tmp_path)


def test_a_checkpoint_survives_the_two_that_follow_it(tmp_path):
    run = MadeUpRun(made_up_layout(samples=100, sections=4), made_up_impacts(30))
    writer = ResultWriter.create(tmp_path / "a1", run.layout)
    run.append(writer, 0.0, 0.2)
    checkpoint = writer.checkpoint()
    for start, stop in pairwise([0.2, 0.5, 0.9]):  # each writes shards and so begins a journal
        run.append(writer, start, stop)
        writer.checkpoint()
    resumed = ResultWriter.resume(
        tmp_path / "a2", run.layout, checkpoint, taken_over_from=tmp_path / "a1"
    )
    assert (resumed.samples, resumed.sections, resumed.impacts) == (20, 1, 6)


class HalfWay(Folder):
    """A folder whose process is killed after so many pieces of an object."""

    survived = 0

    def put(self, key, pieces):
        def some():
            for index, piece in enumerate(pieces):
                if index == self.survived:
                    raise Killed
                yield piece

        super().put(key, some())


@pytest.mark.parametrize("survived", range(0, 80, 9))
def test_a_kill_amid_sealing_leaves_the_checkpoint_valid(tmp_path, monkeypatch, survived):
    run = MadeUpRun(made_up_layout(samples=40, sections=2), made_up_impacts(40))
    writer = ResultWriter.create(tmp_path / "a1", run.layout)
    run.append(writer, 0.0, 1.0)
    checkpoint = writer.checkpoint()
    monkeypatch.setattr(HalfWay, "survived", survived)
    target = StoredObject(HalfWay(str(tmp_path)), "a1.zip")
    with pytest.raises(Killed):
        writer.seal(target, peaks=run.peaks, summary={"steps": 3})
    assert not target.exists()
    resumed = ResultWriter.resume(
        tmp_path / "a2", run.layout, checkpoint, taken_over_from=tmp_path / "a1"
    )
    assert sealed(resumed, tmp_path / "a2", run) == undisturbed(run, tmp_path)


def test_a_checkpoint_is_small_whatever_waits(tmp_path):
    layout = made_up_layout(samples=10_000, sections=0, partition=Partition())
    run = MadeUpRun(layout, made_up_impacts(1000))
    writer = ResultWriter.create(tmp_path / "store", layout)
    run.append(writer, 0.0, 0.5)
    assert (writer.samples, ResultReader(tmp_path / "store").samples) == (5000, 0)
    assert len(writer.checkpoint()) < 1000


def test_a_checkpoint_takes_no_copy_of_what_waits(tmp_path):
    layout = made_up_layout(samples=200_000, sections=0, partition=Partition())
    run = MadeUpRun(layout, made_up_impacts(10))
    writer = ResultWriter.create(tmp_path / "store", layout)
    run.append(writer, 0.0, 0.5)
    waiting = 100_000 * 3 * 8
    tracemalloc.start()
    writer.checkpoint()
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    (journal,) = (tmp_path / "store" / "parts").iterdir()
    assert journal.stat().st_size > waiting
    assert peak < waiting / 20  # buffers of files, and what finds the rows again


def test_taking_over_copies_where_it_cannot_link(tmp_path, tmp_path_factory):
    elsewhere = tmp_path_factory.mktemp("elsewhere")
    if elsewhere.stat().st_dev == tmp_path.stat().st_dev:
        pytest.skip("needs a second file system to copy to")
    run = MadeUpRun(made_up_layout(samples=30, sections=2), made_up_impacts(5))
    writer = ResultWriter.create(tmp_path / "a1", run.layout)
    run.append(writer, 0.0, 0.8)
    resumed = ResultWriter.resume(
        elsewhere / "a2", run.layout, writer.checkpoint(), taken_over_from=tmp_path / "a1"
    )
    run.append(resumed, 0.8, 1.0)
    assert sealed(resumed, elsewhere / "a2", run) == undisturbed(run, tmp_path)


def started(folder, run, reached=0.5):
    writer = ResultWriter.create(folder, run.layout)
    run.append(writer, 0.0, reached)
    return writer.checkpoint()


@pytest.fixture
def run():
    return MadeUpRun(made_up_layout(samples=50, sections=2), made_up_impacts(5))


def test_a_checkpoint_of_another_layout_is_refused(tmp_path, run):
    checkpoint = started(tmp_path / "a1", run)
    other = made_up_layout(samples=51, sections=2)
    with pytest.raises(CheckpointMismatch, match="other channels, counts or joints"):
        ResultWriter.resume(tmp_path / "a2", other, checkpoint, taken_over_from=tmp_path / "a1")


@pytest.mark.parametrize("nonsense", [b"", b"{}", b"[1]", b"\xff\x00", b'{"format": 1}'])
def test_bytes_that_are_no_checkpoint_are_refused(tmp_path, run, nonsense):
    started(tmp_path / "a1", run)
    with pytest.raises(CheckpointMismatch, match="no checkpoint"):
        ResultWriter.resume(tmp_path / "a2", run.layout, nonsense, taken_over_from=tmp_path / "a1")


def test_a_shard_that_is_gone_is_named(tmp_path, run):
    checkpoint = started(tmp_path / "a1", run)
    (tmp_path / "a1/rows/history-1.zip").unlink()
    with pytest.raises(CheckpointMismatch, match=r"a1 lacks slider7\.q0/c/1"):
        ResultWriter.resume(
            tmp_path / "a2", run.layout, checkpoint, taken_over_from=tmp_path / "a1"
        )


def test_a_damaged_journal_is_found_out(tmp_path, run):
    checkpoint = started(tmp_path / "a1", run)
    (journal,) = (tmp_path / "a1/parts").iterdir()
    content = bytearray(journal.read_bytes())
    content[-1] ^= 1
    journal.write_bytes(content)
    with pytest.raises(CorruptStore, match="bytes that the checkpoint describes"):
        ResultWriter.resume(
            tmp_path / "a2", run.layout, checkpoint, taken_over_from=tmp_path / "a1"
        )


def test_a_journal_that_is_gone_is_named(tmp_path, run):
    checkpoint = started(tmp_path / "a1", run)
    shutil.rmtree(tmp_path / "a1/parts")
    with pytest.raises(CheckpointMismatch, match="is gone"):
        ResultWriter.resume(
            tmp_path / "a2", run.layout, checkpoint, taken_over_from=tmp_path / "a1"
        )


def test_a_store_is_never_resumed_over_another(tmp_path, run):
    checkpoint = started(tmp_path / "a1", run)
    with pytest.raises(StoreExists):
        ResultWriter.resume(
            tmp_path / "a1", run.layout, checkpoint, taken_over_from=tmp_path / "a1"
        )
