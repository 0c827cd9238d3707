"""Rows that a study's store refuses, and faults that it survives."""

import errno
import os
from dataclasses import replace
from itertools import count

import numpy as np
import pytest
import zarr
from made_up_studies import MadeUpStudy, made_up_layout, packed, target
from zarr.storage import ZipStore

from jointplay.records.channel import Channel
from jointplay.records.point import Failure, StudySlice
from jointplay.storage.errors import CheckpointMismatch, CorruptStore, InvalidAppend, StoreExists
from jointplay.storage.packed.running import Running
from jointplay.storage.studies import block as block_module
from jointplay.storage.studies.block import StudyBlock
from jointplay.storage.studies.examined_part import require_part
from jointplay.storage.studies.part import Part
from jointplay.storage.studies.reader import StudyReader
from jointplay.storage.studies.store import create, seal


def test_a_restart_file_that_is_damaged_or_of_another_study_is_refused(tmp_path):
    study = MadeUpStudy(made_up_layout())
    create(tmp_path / "store", study.layout)
    block = StudyBlock(tmp_path / "store", study.layout, 0)
    block.take(next(study.slices(0)))
    name = block.flush(b"checkpoint")
    path = tmp_path / "store/parts" / name
    content = path.read_bytes()
    for damaged in (content[:-3], content[:-3] + b"xyz", b"other" + content, b""):
        path.write_bytes(damaged)
        with pytest.raises(CorruptStore, match="cannot be read"):
            StudyBlock.resume(tmp_path / "store", study.layout, 0, 2, name)
    path.write_bytes(content)
    other = made_up_layout(attributes={"job": {"kind": "sweep"}})
    with pytest.raises(CheckpointMismatch, match="another study"):
        StudyBlock.resume(tmp_path / "store", other, 0, 2, name)
    with pytest.raises(FileNotFoundError):
        StudyBlock.resume(tmp_path / "store", study.layout, 1, 2, "00001-a1")
    with pytest.raises(StoreExists, match="another version"):
        create(tmp_path / "store", other)


@pytest.mark.parametrize("record", [7, 9000])
def test_a_part_without_the_chunks_it_builds_on_is_refused(tmp_path, record):
    """A power cut may take files away whose names were not on the disk yet."""
    study = MadeUpStudy(made_up_layout(points=10, record=record, blocks=((0, 8), (8, 2))))
    create(tmp_path, study.layout)
    block = StudyBlock(tmp_path, study.layout, 1)
    for piece in study.slices(1):
        block.take(piece)
    name = block.flush(b"")
    first = 1 if record == 7 else 8  # chunks of eight points, or of one
    missing = tmp_path / f"rows/sections-{first}-0.zip"
    content = missing.read_bytes()
    missing.unlink()
    with pytest.raises(CorruptStore, match=f"lacks sections/time/c/{first}/0, which block 1"):
        StudyBlock.resume(tmp_path, study.layout, 1, 2, name)
    missing.write_bytes(content)
    StudyBlock.resume(tmp_path, study.layout, 1, 2, name)
    study.write_block(tmp_path, 0)
    block.finish()
    missing.unlink()
    assert StudyBlock.done(tmp_path, study.layout, 0)
    assert not StudyBlock.done(tmp_path, study.layout, 1)
    with pytest.raises(CorruptStore, match="lacks"):
        seal(tmp_path, study.layout, target(tmp_path))


KNOWN = ("steps", "energy_residual", "lyapunov", "verdict")


def handed_in(folder, monkeypatch, **changes):
    """Leave a block whose points have what the changes say, and look at it."""
    layout = made_up_layout()
    study = MadeUpStudy(replace(layout, outputs={name: Channel(name, "1") for name in KNOWN}))
    honest = study.end
    monkeypatch.setattr(study, "end", lambda point: replace(honest(point), **changes))
    create(folder, study.layout)
    study.write_block(folder, 0)
    files = Running(folder, digest=study.layout.digest)
    require_part(files, study.layout, 0, same=True)


def test_a_block_that_is_handed_in_as_it_was_computed_is_taken(tmp_path, monkeypatch):
    handed_in(tmp_path, monkeypatch)


@pytest.mark.parametrize(
    "changes",
    [
        {"code": "A code"},
        {"code": "x" * 65},
        {"code": "ill\0"},
        {"code": "ill", "detail": "x" * 10_001},
        {"code": "ill", "detail": "\x1b[2J"},
        {"code": "ill", "detail": "\ud800"},
        {"reason": "x" * 10_001},
        {"statistics": {"steps": 1.0, "made_up": 1.0}},
        {"indicators": {"verdict": 1.0, "made_up": 1.0}},
    ],
)
def test_a_block_with_what_no_point_has_is_not_taken(tmp_path, monkeypatch, changes):
    with pytest.raises(CorruptStore):
        handed_in(tmp_path, monkeypatch, **changes)


def spoiled(part, **arrays):
    """Return a part as a program of somebody's own might write it."""
    for name, value in arrays.items():
        setattr(part, name, value)
    return part


@pytest.mark.parametrize(
    "harm",
    [
        lambda part: spoiled(part, status=part.status[:-1]),
        lambda part: spoiled(part, counts=part.counts + 1000),
        lambda part: spoiled(part, counts=-part.counts - 1),
        lambda part: spoiled(part, peaks=part.peaks[:, :0]),
        lambda part: spoiled(part, numbers={"statistics/steps": np.zeros((3, 3))}),
        lambda part: spoiled(part, numbers={"../steps": part.status}),
        lambda part: spoiled(part, reasons={0: 3}),
        lambda part: spoiled(part, reasons={10**6: "of another block"}),
        lambda part: spoiled(part, failures={0: Failure("ill", 7, 0.0)}),
        lambda part: spoiled(part, failures={0: ("one", "word")}),
        lambda part: spoiled(part, open={(0, 0): np.zeros(3)}),
        lambda part: spoiled(part, open={(99, 0): np.zeros((1, 1, 1))}),
        lambda part: spoiled(part, documents={0: "no object"}),
    ],
)
def test_of_a_block_that_goes_on_nothing_is_read_that_the_job_cannot_have(tmp_path, harm):
    """A worker of somebody's own sends it; readers had errors of the service."""
    study = MadeUpStudy(made_up_layout())
    create(tmp_path, study.layout)
    block = StudyBlock(tmp_path, study.layout, 0)
    block.take(next(study.slices(0)))
    name = block.flush(b"")
    honest = StudyReader(tmp_path).status
    path, digest = tmp_path / "parts" / name, study.layout.digest
    part = Part.read(Running(tmp_path, digest=digest), name, digest)
    path.write_bytes(part.encode(study.layout))
    assert StudyReader(tmp_path).status.tolist() == honest.tolist()
    path.write_bytes(harm(part).encode(study.layout))
    with pytest.raises(CorruptStore):
        _ = StudyReader(tmp_path).status


@pytest.mark.parametrize("time", [10**400, True, "1", None])
def test_a_block_whose_point_failed_at_no_time_is_not_taken(tmp_path, monkeypatch, time):
    monkeypatch.setattr(
        block_module, "Failure", lambda code, detail, _: Failure(code, detail, time)
    )
    with pytest.raises(CorruptStore):
        handed_in(tmp_path, monkeypatch)


def test_a_study_whose_points_fail_for_more_reasons_than_there_are_is_sealed(tmp_path, monkeypatch):
    study = MadeUpStudy(made_up_layout(points=300), failing=range(300))
    honest = study.end
    monkeypatch.setattr(study, "end", lambda point: replace(honest(point), code=f"ill-{point:03}"))
    path = study.write(tmp_path / "store")
    reader = StudyReader(path)
    assert [one.code for one in reader.failures.values()] == [f"ill-{k:03}" for k in range(300)]
    names = reader.attributes["failures"]
    told = [names[code] for code in zarr.open_array(ZipStore(path, mode="r"), path="failure")[:]]
    assert told == [f"ill-{k:03}" for k in range(254)] + ["other"] * 46


@pytest.mark.parametrize("written", [0, 1, 3, 5, 8])
def test_after_a_full_disk_the_last_flush_is_resumed(tmp_path, monkeypatch, written):
    study = MadeUpStudy(made_up_layout(points=10, record=9000, blocks=((0, 8), (8, 2))))
    undisturbed = study.write(tmp_path / "undisturbed").read_bytes()
    folder = tmp_path / "store"
    create(folder, study.layout)
    pieces = list(study.slices(0, 1500))
    block = StudyBlock(folder, study.layout, 0)
    for piece in pieces[:2]:
        block.take(piece)
    name = block.flush(b"")
    write, calls = os.fsync, count()

    def write_until_full(descriptor):
        if next(calls) >= written:
            raise OSError(errno.ENOSPC, "No space left on device")
        write(descriptor)

    def go_on():
        for piece in pieces[2:]:
            block.take(piece)
            block.flush(b"")

    with monkeypatch.context() as full:
        full.setattr(os, "fsync", write_until_full)
        with pytest.raises(OSError, match="No space left"):
            go_on()
    assert (StudyReader(folder).counts[:8] > 0).any()
    other, _ = StudyBlock.resume(folder, study.layout, 0, 2, name)
    for piece in pieces[2:]:
        other.take(piece)
    other.finish()
    study.write_block(folder, 1)
    seal(folder, study.layout, target(folder))
    assert packed(folder).read_bytes() == undisturbed


def test_a_failure_without_a_time_is_kept(tmp_path):
    study = MadeUpStudy(made_up_layout(points=8))
    create(tmp_path, study.layout)
    block = StudyBlock(tmp_path, study.layout, 0)
    ends = tuple(replace(study.end(point), time=float("nan")) for point in range(8))
    block.take(StudySlice(1.0, tuple(range(8)), (), ends))
    block.finish()
    running = StudyReader(tmp_path).failures[3]
    seal(tmp_path, study.layout, target(tmp_path))
    sealed = StudyReader(packed(tmp_path)).failures[3]
    assert running[:2] == sealed[:2]
    assert np.isnan(running.time)
    assert np.isnan(sealed.time)


def test_a_store_cut_off_while_it_was_made_is_made_again(tmp_path):
    study = MadeUpStudy(made_up_layout())
    create(tmp_path, study.layout)
    whole = (tmp_path / "documents.zip").read_bytes()
    (tmp_path / "documents.zip").write_bytes(b"")
    create(tmp_path, study.layout)
    assert (tmp_path / "documents.zip").read_bytes() == whole


@pytest.mark.parametrize(
    ("piece", "sentence"),
    [
        (lambda study: StudySlice(0, (8,), (), ()), "point 8 is not one of the 8 from 0"),
        (lambda study: StudySlice(0, (), (study.rows(1, 2, 3),), ()), "sections 2 to 2 do not"),
        (
            lambda study: StudySlice(0, (), (replace(study.rows(1, 0, 2), first=6),), ()),
            "do not follow",
        ),
        (
            lambda study: StudySlice(
                0, (), (replace(study.rows(1, 0, 2), values=np.zeros((2, 5))),), ()
            ),
            r"need shape \(2, 2\)",
        ),
        (lambda study: StudySlice(0, (), (), (study.end(1), study.end(1))), "1 ended before"),
        (
            lambda study: StudySlice(0, (), (study.rows(0, 0, 1),), (study.end(0),)),
            "0 has ended and takes no more",
        ),
    ],
)
def test_what_does_not_fit_is_refused(tmp_path, piece, sentence):
    study = MadeUpStudy(made_up_layout())
    create(tmp_path, study.layout)
    block = StudyBlock(tmp_path, study.layout, 0)
    if "takes no more" in sentence:
        block.take(StudySlice(0, (), (), (study.end(0),)))
    with pytest.raises(InvalidAppend, match=sentence):
        block.take(piece(study))


def test_a_block_is_not_finished_before_its_points_are(tmp_path):
    study = MadeUpStudy(made_up_layout())
    create(tmp_path, study.layout)
    block = StudyBlock(tmp_path, study.layout, 0)
    block.take(StudySlice(0.1, (0,), (), (study.end(0),)))
    with pytest.raises(InvalidAppend, match="7 points of block 0 have not ended"):
        block.finish()
    assert not StudyBlock.done(tmp_path, study.layout, 0)
    study.write_block(tmp_path, 0)
    assert StudyBlock.done(tmp_path, study.layout, 0)


def test_of_two_seals_that_differ_the_second_is_refused(tmp_path):
    study = MadeUpStudy(made_up_layout(points=8))
    first = study.write(tmp_path / "store").read_bytes()
    seal(tmp_path / "store", study.layout, target(tmp_path / "store"))  # the same
    study.steps = study.steps + 1.0
    study.write_block(tmp_path / "store", 0)
    with pytest.raises(StoreExists, match="sealed before, with other bytes"):
        seal(tmp_path / "store", study.layout, target(tmp_path / "store"))
    assert packed(tmp_path / "store").read_bytes() == first
