"""Rows of a growing store that wait for their shard, as a reader sees them."""

from dataclasses import replace

import numpy as np
import pytest

from jointplay.storage.errors import CorruptStore
from jointplay.storage.packed import Running
from jointplay.storage.results.live import LiveStore
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.results.writer import ResultWriter
from tests.storage.results.made_up_runs import MadeUpRun, made_up_impacts, made_up_layout


@pytest.fixture
def run():
    return MadeUpRun(made_up_layout(samples=200, sections=40), made_up_impacts(30))


def shown(reader):
    return reader.samples, len(reader.sections()[0]), len(reader.impacts())


@pytest.mark.parametrize("stop", [0.01, 0.02, 0.06, 0.3, 0.5, 0.999, 1.0])
def test_all_tables_end_where_the_checkpoint_was_made(tmp_path, run, stop):
    writer = ResultWriter.create(tmp_path / "store", run.layout)
    run.append(writer, 0.0, stop / 2)
    writer.checkpoint()
    run.append(writer, stop / 2, stop)
    writer.checkpoint()
    committed = writer.samples, writer.sections, writer.impacts
    run.append(writer, stop, 1.0)  # in memory, or in shards without a checkpoint
    reader = ResultReader(tmp_path / "store", committed[0])
    assert shown(reader) == committed
    time, columns = reader.history()
    np.testing.assert_array_equal(time, run.time[: committed[0]])
    np.testing.assert_array_equal(columns["slider7.q1"], run.samples[: committed[0], 1])
    np.testing.assert_array_equal(reader.impacts(), run.impacts[: committed[2]])
    time, columns = reader.sections(["slider7.q0"])
    np.testing.assert_array_equal(columns["slider7.q0"], run.sections[: committed[1], 0])
    middle = reader.history(["slider7.q0"], committed[0] // 2, committed[0] - 1)[1]
    expected = run.samples[committed[0] // 2 : committed[0] - 1, 0]
    np.testing.assert_array_equal(middle["slider7.q0"], expected)


def test_a_checkpoint_that_is_half_written_does_not_count(tmp_path, run):
    writer = ResultWriter.create(tmp_path / "store", run.layout)
    run.append(writer, 0.0, 0.02)
    writer.checkpoint()
    committed = writer.samples
    (journal,) = (tmp_path / "store/parts").iterdir()
    whole = journal.read_bytes()
    run.append(writer, 0.02, 0.025)
    writer.checkpoint()
    later = journal.read_bytes()
    assert later.startswith(whole)
    for size in range(len(whole), len(later)):
        journal.write_bytes(later[:size])
        assert shown(ResultReader(tmp_path / "store", committed))[0] == committed
        with pytest.raises(CorruptStore, match=f"of {writer.samples} samples that are committed"):
            ResultReader(tmp_path / "store", writer.samples)


def test_a_checkpoint_whose_journal_was_replaced_is_found_in_shards(tmp_path, run):
    writer = ResultWriter.create(tmp_path / "store", run.layout)
    run.append(writer, 0.0, 0.2)
    assert (writer.samples, ResultReader(tmp_path / "store").samples) == (40, 36)
    assert ResultReader(tmp_path / "store", 30).samples == 30
    with pytest.raises(CorruptStore, match="of 40 samples that are committed, 36 rows"):
        ResultReader(tmp_path / "store", 40)


@pytest.mark.parametrize("at", range(0, 900, 7))
def test_a_flipped_bit_of_the_journal_takes_no_row_silently(tmp_path, run, at):
    writer = ResultWriter.create(tmp_path / "store", run.layout)
    run.append(writer, 0.0, 0.02)
    writer.checkpoint()
    (journal,) = (tmp_path / "store/parts").iterdir()
    content = bytearray(journal.read_bytes())
    content[at % len(content)] ^= 1 << at % 8
    journal.write_bytes(content)
    with pytest.raises(CorruptStore, match="committed"):
        ResultReader(tmp_path / "store", writer.samples)


def test_another_jobs_journal_is_refused(tmp_path, run):
    journals = []
    for name in ("one", "other"):
        layout = replace(run.layout, attributes={"digest": name})
        writer = ResultWriter.create(tmp_path / name, layout)
        run.append(writer, 0.0, 0.02)
        writer.checkpoint()
        journals += (tmp_path / name / "parts").iterdir()
    one, other = journals
    assert ResultReader(tmp_path / "one", writer.samples).samples == writer.samples
    one.write_bytes(other.read_bytes())
    with pytest.raises(CorruptStore, match="committed"):
        ResultReader(tmp_path / "one", writer.samples)


def test_a_shard_that_is_gone_takes_no_row_silently(tmp_path, run):
    writer = ResultWriter.create(tmp_path / "store", run.layout)
    run.append(writer, 0.0, 0.5)
    writer.checkpoint()
    assert ResultReader(tmp_path / "store", writer.samples).samples == writer.samples
    shards = sorted((tmp_path / "store/rows").glob("history-*"))
    assert len(shards) > 1
    for shard in shards:
        content = shard.read_bytes()
        shard.unlink()
        with pytest.raises(CorruptStore, match=r"committed|lacks"):
            ResultReader(tmp_path / "store", writer.samples)
        shard.write_bytes(content)


def test_documents_of_groups_and_arrays_agree(tmp_path, run):
    writer = ResultWriter.create(tmp_path / "store", run.layout)
    run.append(writer, 0.0, 0.3)
    writer.checkpoint()
    store = LiveStore(Running(tmp_path / "store"), writer.samples)
    assert store.document("nothing/zarr.json") is None
    assert b'"shape":[60]' in (store.document("time/zarr.json") or b"")
    root = store.document("zarr.json") or b""
    assert root.count(b'"shape":[60]') == 3
    assert (store.document("poincare/zarr.json") or b"").count(b'"shape":[12]') == 3
