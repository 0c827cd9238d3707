"""Extremes between samples in a store: read back sealed, growing, and after it was taken over."""

from dataclasses import replace

import numpy as np
import pytest

from jointplay.records.run_rows import RunRows
from jointplay.storage.packed import Running
from jointplay.storage.results.intervals import ROWS, columns
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.results.writer import ResultWriter
from tests.storage.results.made_up_runs import MadeUpRun, made_up_impacts, made_up_layout
from tests.stores import packed, target

SAMPLES, FIRST = 3 * ROWS, 40


@pytest.fixture(scope="module")
def run():
    layout = replace(made_up_layout(SAMPLES, 0), intervals=True)
    return MadeUpRun(layout, made_up_impacts(0))


@pytest.fixture(scope="module")
def rows(run):
    """Extremes of all intervals but those of the first samples, whose steps are kept."""
    width = len(columns(channel.name for channel in run.layout.channels))
    found = np.random.default_rng(7).normal(size=(SAMPLES - FIRST, width))
    found[:, 0] = np.arange(FIRST, SAMPLES)
    return found


def append(writer, run, rows, first, last):
    known = rows[(rows[:, 0] >= first) & (rows[:, 0] < last)]
    part = slice(first, last)
    writer.append(
        RunRows(
            first_sample=first,
            sample_time=run.time[part],
            samples=run.samples[part],
            impacts=run.impacts,
            intervals=known,
        )
    )


def seal(writer, run, folder):
    writer.seal(target(folder), peaks=run.peaks, summary={})
    return packed(folder)


def check(reader, run, rows, last):
    stored = reader.intervals
    assert (stored.first, stored.count) == (FIRST, last - FIRST)
    for c, channel in enumerate(run.layout.channels):
        for low, high in ((FIRST, last), (FIRST + 3, min(ROWS + 50, last)), (last - 1, last)):
            expected = rows[low - FIRST : high - FIRST, 1 + 2 * c : 3 + 2 * c]
            assert np.array_equal(stored.read(channel.name, low, high), expected)


def test_a_sealed_store_gives_back_every_interval(run, rows, tmp_path):
    writer = ResultWriter.create(tmp_path / "r", run.layout)
    append(writer, run, rows, 0, SAMPLES)
    check(ResultReader(seal(writer, run, tmp_path / "r")), run, rows, SAMPLES)


@pytest.mark.parametrize("kept", [20, 900, 2100])
def test_a_growing_store_shows_those_that_are_committed_and_is_taken_over(
    run, rows, tmp_path, kept
):
    lost = ResultWriter.create(tmp_path / "lost", run.layout)
    append(lost, run, rows, 0, kept)
    checkpoint = lost.checkpoint()
    append(lost, run, rows, kept, SAMPLES - 5)  # nobody was told of these
    growing = ResultReader(Running(tmp_path / "lost", digest=""), kept)
    if kept > FIRST:
        check(growing, run, rows, kept)
    else:
        assert growing.intervals is None
    again = ResultWriter.resume(
        tmp_path / "again", run.layout, checkpoint, taken_over_from=tmp_path / "lost"
    )
    append(again, run, rows, kept, SAMPLES)
    whole = ResultWriter.create(tmp_path / "whole", run.layout)
    append(whole, run, rows, 0, SAMPLES)
    found, expected = (
        seal(writer, run, tmp_path / name) for writer, name in ((again, "again"), (whole, "whole"))
    )
    assert found.read_bytes() == expected.read_bytes()
