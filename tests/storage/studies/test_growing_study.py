"""A study that runs shows what is known, and its bytes depend on the results alone."""

import contextlib
import json
import random
import shutil
import threading

import numpy as np
import pytest
from made_up_studies import MadeUpStudy, made_up_layout, packed, target

from jointplay.storage.errors import IncompleteStudy
from jointplay.storage.packed import Running
from jointplay.storage.studies.block import StudyBlock
from jointplay.storage.studies.reader import StudyReader
from jointplay.storage.studies.store import create, seal


def test_a_running_study_shows_every_flush(tmp_path, study, step):
    create(tmp_path, study.layout)
    block = StudyBlock(tmp_path, study.layout, 0)
    known = np.zeros(study.layout.points, int)
    status = np.zeros(study.layout.points, int)
    for piece in study.slices(0, step):
        block.take(piece)
        block.flush(b"")
        for point in piece.started:
            status[point] = 1
        for rows in piece.rows:
            known[rows.point] = rows.first + len(rows.time)
        for end in piece.ended:
            status[end.point] = 3 if end.code else 2
        reader = StudyReader(tmp_path)
        np.testing.assert_array_equal(reader.status, status)
        np.testing.assert_array_equal(reader.counts, known)
        expected = study.sections[:, :, 1].copy()
        for point, sections in enumerate(known):
            expected[point, sections:] = np.nan
        np.testing.assert_array_equal(reader.sections("slider7.q1"), expected)
        np.testing.assert_array_equal(reader.sections("slider7.q1", 1, 4), expected[1:4])
        ended = status >= 2
        np.testing.assert_array_equal(
            reader.statistics.get("steps", np.full(len(ended), np.nan)),
            np.where(ended, study.steps, np.nan),
        )
        np.testing.assert_array_equal(
            reader.peaks("A.force1").maximum, np.where(ended, study.peaks[:, 1, 2], np.nan)
        )
    assert block.watermark == study.layout.blocks[0][1]
    assert not StudyReader(tmp_path).complete


def test_the_bytes_do_not_depend_on_slices_order_or_number_of_writers(
    tmp_path, study, step, undisturbed
):
    folder = tmp_path / "other"

    def write(index):
        create(folder, study.layout)
        block = StudyBlock(folder, study.layout, index)
        for piece in study.slices(index, step + 1, lanes=3):
            block.take(piece)
            block.flush(b"checkpoint")
        block.finish()

    writers = [
        threading.Thread(target=write, args=(index,))
        for index in reversed(range(len(study.layout.blocks)))
    ]
    for writer in writers:
        writer.start()
    for writer in writers:
        writer.join()
    seal(folder, study.layout, target(folder))
    assert packed(folder).read_bytes() == undisturbed


@pytest.mark.parametrize("seed", range(3))
def test_a_block_left_and_resumed_anywhere_has_the_same_bytes(
    tmp_path, study, step, undisturbed, seed
):
    chance = random.Random(seed)
    folder = tmp_path / "interrupted"
    create(folder, study.layout)
    for index in range(len(study.layout.blocks)):
        pieces = list(study.slices(index, step))
        attempt, reached, name = 1, 0, None
        block = StudyBlock(folder, study.layout, index, attempt)
        while reached < len(pieces):
            stop = chance.randint(reached, len(pieces))
            for piece in pieces[reached:stop]:
                block.take(piece)
            if chance.random() < 0.7 or stop == len(pieces):
                reached = stop
                name = block.flush(reached.to_bytes(4, "little"))
            elif name is None:
                reached = 0
            attempt += 1  # killed: what came after the last flush is gone
            if name is None:
                block = StudyBlock(folder, study.layout, index, attempt)
            else:
                block, carried = StudyBlock.resume(folder, study.layout, index, attempt, name)
                assert int.from_bytes(carried, "little") == reached
        block.finish()
    seal(folder, study.layout, target(folder))
    assert packed(folder).read_bytes() == undisturbed


def test_a_late_worker_changes_nothing(tmp_path, study, step, undisturbed):
    """Given up in mid-block, it goes on while another takes over, finishes and seals."""
    folder = tmp_path / "store"
    create(folder, study.layout)
    pieces = list(study.slices(0, step))
    late = StudyBlock(folder, study.layout, 0, attempt=1)
    for piece in pieces[: len(pieces) // 2]:
        late.take(piece)
    name = late.flush(b"")
    held_up = iter(pieces[len(pieces) // 2 :])
    late.take(next(held_up))

    other, _ = StudyBlock.resume(folder, study.layout, 0, 2, name)
    for piece in pieces[len(pieces) // 2 :]:
        other.take(piece)
    late.flush(b"")
    other.finish()
    for index in range(1, len(study.layout.blocks)):
        study.write_block(folder, index)
    late.flush(b"")
    reader = StudyReader(folder)
    assert (reader.status >= 2).all()  # the last part counts, not that of an attempt
    seal(folder, study.layout, target(folder))

    shutil.rmtree(folder)  # whoever ended the job takes its folder away
    for piece in held_up:
        with contextlib.suppress(FileNotFoundError):
            late.take(piece)
    with pytest.raises(FileNotFoundError):
        late.finish()
    assert packed(folder).read_bytes() == undisturbed
    assert not folder.exists()


def test_sealing_may_be_repeated_and_a_late_one_changes_nothing(tmp_path, study, undisturbed):
    folder = tmp_path / "store"
    sealed = study.write(folder)
    seal(folder, study.layout, target(folder))
    shutil.rmtree(folder)
    seal(folder, study.layout, target(folder))
    assert sealed.read_bytes() == undisturbed


def test_an_interrupted_sealing_is_done_again(tmp_path, study, undisturbed):
    folder = tmp_path / "store"
    create(folder, study.layout)
    for index in range(len(study.layout.blocks)):
        study.write_block(folder, index)

    def interrupt():
        raise InterruptedError

    with pytest.raises(InterruptedError):
        seal(folder, study.layout, target(folder), interrupt)
    assert not StudyReader(folder).sealed
    (folder.parent / "store.zip.1234.partial").write_bytes(b"cut off with a killed worker")
    seal(folder, study.layout, target(folder))
    assert packed(folder).read_bytes() == undisturbed


def test_nothing_is_sealed_before_every_block_is_done(tmp_path, study):
    create(tmp_path, study.layout)
    study.write_block(tmp_path, 0)
    with pytest.raises(IncompleteStudy, match=r"blocks of .* are not done, such as 1"):
        seal(tmp_path, study.layout, target(tmp_path))


def test_a_reader_survives_that_the_study_is_sealed_under_it(tmp_path):
    study = MadeUpStudy(made_up_layout())
    create(tmp_path, study.layout)
    for index in range(len(study.layout.blocks)):
        study.write_block(tmp_path, index)
    early = StudyReader(Running(tmp_path, target(tmp_path)))
    np.testing.assert_array_equal(early.values, study.layout.values)
    seal(tmp_path, study.layout, target(tmp_path))
    shutil.rmtree(tmp_path)
    assert (early.status >= 2).all()
    np.testing.assert_array_equal(early.sections("slider7.q0"), study.sections[:, :, 0])
    np.testing.assert_array_equal(early.peaks("A.force0").minimum, study.peaks[:, 0, 0])


def test_readers_beside_writers_see_only_what_is_so(tmp_path):
    """Values, once seen, are right and never go again, while blocks finish and the seal is set."""
    study = MadeUpStudy(made_up_layout(points=64, record=40))
    create(tmp_path, study.layout)
    done = threading.Event()
    findings = []

    def read():
        seen = 0
        while True:
            last = done.is_set()
            reader = StudyReader(Running(tmp_path, target(tmp_path)))
            status, found = reader.status, reader.sections("slider7.q0")
            known = ~np.isnan(found)
            if not np.array_equal(found[known], study.sections[:, :, 0][known]):
                findings.append("wrong values")
            if (known.sum(axis=1) < reader.counts).any():
                findings.append("fewer sections than counted")
            if (status >= 2).sum() < seen:
                findings.append("points went back")
            seen = (status >= 2).sum()
            if last:
                return

    reading = threading.Thread(target=read)
    reading.start()
    for index in range(len(study.layout.blocks)):
        block = StudyBlock(tmp_path, study.layout, index)
        for piece in study.slices(index):
            block.take(piece)
            block.flush(b"")
        block.finish()
    seal(tmp_path, study.layout, target(tmp_path))
    done.set()
    reading.join()
    assert findings == []


def test_json_of_a_growing_store_says_that_it_is_not_complete(tmp_path):
    study = MadeUpStudy(made_up_layout())
    create(tmp_path, study.layout)
    root = json.loads(Running(tmp_path).read("zarr.json"))
    assert root["attributes"]["complete"] is False
    assert root["attributes"]["job"] == {"kind": "bifurcation"}
    reader = StudyReader(tmp_path)
    assert (reader.status == 0).all()
    assert np.isnan(reader.sections("slider7.q0")).all()
    assert reader.verdicts is None
