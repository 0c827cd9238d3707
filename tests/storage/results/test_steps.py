"""Accepted steps in a store: found by time, in files and in the journal, sealed and growing."""

import numpy as np
import pytest

from jointplay.records.run_rows import RunRows
from jointplay.storage.errors import InvalidAppend
from jointplay.storage.packed import Running
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.results.steps import ROWS
from jointplay.storage.results.writer import ResultWriter
from tests.storage.results.made_up_runs import MadeUpRun, made_up_impacts, made_up_layout
from tests.stores import packed, target

COLUMNS = ("period", "time", "length", "x")
PERIOD = 0.5


@pytest.fixture(scope="module")
def run():
    """As many steps as three files and a part of one hold, each of its own length."""
    made = MadeUpRun(made_up_layout(8000, 5, steps=COLUMNS), made_up_impacts(9))
    random = np.random.default_rng(3)
    ends = np.cumsum(random.uniform(0.5, 1.5, len(made.steps)) * 1e-4)
    begins = np.concatenate([[0.0], ends[:-1]])
    made.steps[:, 0] = np.floor(begins / PERIOD)
    made.steps[:, 1] = begins - PERIOD * made.steps[:, 0]
    made.steps[:, 2] = ends - begins
    return made


def test_a_sealed_store_gives_back_every_step(run, tmp_path):
    steps = ResultReader(packed_run(run, tmp_path)).steps
    assert steps.columns == COLUMNS
    assert steps.count == len(run.steps) > 2 * ROWS
    assert np.array_equal(steps.read(0, steps.count), run.steps)
    window = slice(ROWS - 3, 2 * ROWS + 5)
    assert np.array_equal(steps.read(window.start, window.stop), run.steps[window])
    assert steps.end == pytest.approx(run.steps[:, 2].sum(), rel=1e-12)


def packed_run(run, folder):
    run.write(folder / "r", (0.0, 0.3, 0.31, 1.0))
    return packed(folder / "r")


def test_steps_around_a_window_are_few_and_enough(run, tmp_path):
    steps = ResultReader(packed_run(run, tmp_path)).steps
    begins = run.steps[:, 0] * PERIOD + run.steps[:, 1]
    ends = begins + run.steps[:, 2]
    random = np.random.default_rng(5)
    for start in [0.0, *random.uniform(0.0, steps.end, 40), *begins[[1, ROWS - 1, ROWS, 2 * ROWS]]]:
        stop = min(start + 0.01 * random.uniform(), steps.end)
        first, last = steps.around(start, stop)
        assert begins[first] <= start
        assert ends[last - 1] >= stop * (1.0 - 1e-12)
        inside = np.count_nonzero((ends >= start) & (begins <= stop))
        assert inside <= last - first <= inside + 3


@pytest.mark.parametrize("kept", [0.2, 0.8])
def test_a_run_that_is_taken_over_loses_no_step_and_gives_the_same_store(run, tmp_path, kept):
    lost = ResultWriter.create(tmp_path / "lost", run.layout)
    run.append(lost, 0.0, kept)
    checkpoint = lost.checkpoint()
    run.append(lost, kept, 0.9)  # nobody was told of these
    growing = ResultReader(Running(tmp_path / "lost", digest=""), round(kept * 8000))
    seen = growing.steps
    assert seen.count == round(kept * len(run.steps))
    assert np.array_equal(seen.read(0, seen.count), run.steps[: seen.count])
    again = ResultWriter.resume(
        tmp_path / "again", run.layout, checkpoint, taken_over_from=tmp_path / "lost"
    )
    run.append(again, kept, 1.0)
    again.seal(target(tmp_path / "again"), peaks=run.peaks, summary={"steps": 3})
    whole = packed_run(run, tmp_path)
    assert packed(tmp_path / "again").read_bytes() == whole.read_bytes()


def test_a_store_without_steps_says_so_and_others_are_not_taken(tmp_path):
    layout = made_up_layout(10, 0)
    plain = MadeUpRun(layout, made_up_impacts(0))
    assert ResultReader(plain.write(tmp_path / "r")).steps is None
    writer = ResultWriter.create(tmp_path / "w", layout)
    with pytest.raises(InvalidAppend, match="columns"):
        writer.append(RunRows(steps=np.zeros((1, 4))))
