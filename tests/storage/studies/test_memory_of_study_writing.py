"""The memory of writing a study grows neither with its periods nor with its values."""

import tracemalloc
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import numpy as np
from made_up_studies import MadeUpStudy, made_up_layout

from jointplay.records.point import StudySlice
from jointplay.storage.studies.block import StudyBlock
from jointplay.storage.studies.store import create


def test_memory_is_flat_in_periods_and_values(tmp_path):
    # in a process of its own: what other threads of this one allocate would be counted, too
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        few, periods, values = pool.map(
            memory_of_writing, [tmp_path] * 3, [1, 1, 100], [50_000, 1_000_000, 5000]
        )
    assert periods < 1.2 * few
    assert values < 1.2 * few  # each point has some numbers beside its sections


def memory_of_writing(folder, points, record, step=1000):
    """Largest memory allocated while a study is written, in bytes."""
    layout = made_up_layout(points=points, record=record, observables=4, blocks=((0, points),))
    folder = folder / f"{points}x{record}"
    create(folder, layout)
    block = StudyBlock(folder, layout, 0)
    sections = np.random.default_rng(0).normal(size=(step, 4))
    time = np.arange(float(step))
    made_up = MadeUpStudy(made_up_layout())
    rows_type, end_type = type(made_up.rows(0, 0, 0)), type(made_up.end(0))
    nothing = np.full((3, 4), np.nan)
    tracemalloc.start()
    for point in range(points):
        for first in range(0, record, step):
            block.take(StudySlice(0, (), (rows_type(point, first, time + first, sections),), ()))
            if first % (7 * step) == 0:
                block.flush(b"")
        block.take(StudySlice(0, (), (), (end_type(point, "", "", 1.0, nothing, {}, {}),)))
    block.finish()
    found = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return found
