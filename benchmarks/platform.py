"""Demands of a bifurcation diagram on broker, catalogue and disk, against what each sustains.

    python -m benchmarks platform

For planning beyond one machine. The demand is counted while the case of `benchmarks.sweep` is
computed, block after block, as a worker does; the capacities are measured on this machine: one
private Valkey, one SQLite file, one disk, driven by as many processes as there are cores. The
last column says how many cores could compute before the first of them is busy all the time.
"""

import multiprocessing
import os
import sqlite3
import tempfile
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from redis import Redis
from sqlalchemy import Engine, event

from benchmarks.sweep import RECORD, SETTLE, VALUES, document
from jointplay.records.point import PointEnd, SectionRows, StudySlice
from jointplay.service.processes import running_service
from jointplay.solver.kinds import Study, admit
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage import durable
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import BlockEnd, BlockState, JobState, NewJob
from jointplay.storage.settings import Settings
from jointplay.storage.studies.block import StudyBlock
from jointplay.storage.studies.store import create
from jointplay.worker.app import RUN_BLOCK, make_app
from jointplay.worker.block_run import BlockRun
from jointplay.worker.layouts import layout_of_study

SECONDS = 3.0
"""For which each capacity is driven."""
MESSAGES = 2000
BATCH = 10_000
CORES = os.cpu_count() or 1


def the_study() -> Study:
    """Return the case."""
    study = admit(document())
    assert isinstance(study, Study)
    return study


def submitted(catalogue: Catalogue, study: Study) -> str:
    """Queue the case and return the job's id."""
    new = NewJob(
        study.kind, study.job, study.digest, SOLVER_VERSION, blocks=study.blocks, seal=True
    )
    return catalogue.submit(new).job.id


@contextmanager
def counted(counts: Counter[str]) -> Iterator[None]:
    """Count transactions, files, bytes and waits for the disk while it lasts."""

    def statement(*arguments: Any) -> None:
        begin = arguments[2]
        if begin.startswith("BEGIN"):
            counts["writing" if "IMMEDIATE" in begin else "reading"] += 1

    draft, fsync = durable.draft, os.fsync

    def measured(pieces: Iterable[bytes]) -> Iterator[bytes]:
        for piece in pieces:
            counts["bytes"] += len(piece)
            yield piece

    def counting_draft(path: Path, pieces: Iterable[bytes], *, lasting: bool = True) -> Path:
        counts["files"] += 1
        return draft(path, measured(pieces), lasting=lasting)

    def counting_fsync(descriptor: int) -> None:
        counts["syncs"] += 1
        fsync(descriptor)

    durable.draft, os.fsync = counting_draft, counting_fsync  # type: ignore[assignment]
    event.listen(Engine, "before_cursor_execute", statement)
    try:
        yield
    finally:
        event.remove(Engine, "before_cursor_execute", statement)
        durable.draft, os.fsync = draft, fsync


def demand(folder: Path) -> tuple[Counter[str], float]:
    """Compute the case and return what was asked for, and the seconds of processor time."""
    settings = Settings(data=folder)
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    counts: Counter[str] = Counter()
    job = submitted(catalogue, the_study())
    begun = time.process_time()
    with counted(counts):
        while not catalogue.get(job).state.terminal:
            for wake_up in catalogue.due_wake_ups(1000):
                counts["messages"] += 1
                claim = catalogue.claim_block(wake_up.block, "benchmark", settings.lease)
                assert claim is not None
                BlockRun(catalogue, settings, claim, threading.Event()).run()
    seconds = time.process_time() - begun
    assert catalogue.get(job).state is JobState.succeeded
    catalogue.close()
    return counts, seconds


def publishing_and_waking(folder: Path) -> tuple[float, float]:
    """Messages a second that one relay can send, and that workers on all cores can act on."""
    with running_service(folder, workers=CORES):
        url = f"unix://{folder / 'broker' / 'redis.sock'}"
        app = make_app(url)
        app.send_task(RUN_BLOCK, args=["nothing-0"], queue="jobs")  # connects
        with Redis.from_url(url) as redis:
            wait_for_empty(redis)
            begun = time.perf_counter()
            for _ in range(MESSAGES):
                app.send_task(RUN_BLOCK, args=["nothing-0"], queue="jobs")
            sent = time.perf_counter()
            left = int(redis.llen("jointplay:jobs"))
            wait_for_empty(redis)
            taken = time.perf_counter()
        app.close()
    return MESSAGES / (sent - begun), max(left, 1) / (taken - sent)


def wait_for_empty(redis: Redis) -> None:
    """Return when workers have taken every message."""
    while redis.llen("jointplay:jobs"):
        time.sleep(0.005)


def rate(target: Callable[..., None], *arguments: Any) -> float:
    """Drive something from a process on each core and return how often a second it went."""
    context = multiprocessing.get_context("spawn")
    barrier, results = context.Barrier(CORES), context.Queue()
    processes = [
        context.Process(target=target, args=(barrier, results, index, *arguments))
        for index in range(CORES)
    ]
    for process in processes:
        process.start()
    found = sum(results.get() for _ in processes)
    for process in processes:
        process.join()
    return float(found)


def report_progress(barrier: Any, results: Any, index: int, url: str, blocks: list[str]) -> None:
    """Record progress, as a worker does once a second."""
    catalogue = Catalogue(url)
    block = blocks[index]
    assert catalogue.claim_block(block, "benchmark", 600)
    barrier.wait()
    done, begun = 0, time.perf_counter()
    while time.perf_counter() - begun < SECONDS:
        catalogue.record_checkpoint(block, 1, watermark=done, checkpoint="point")
        catalogue.record_progress(block, 1, 600, time=0.0, fraction=0.5)
        done += 2
    results.put(done / (time.perf_counter() - begun))


def begin_and_end(barrier: Any, results: Any, index: int, url: str, blocks: list[str]) -> None:
    """Claim and finish blocks, as a worker does for each."""
    catalogue = Catalogue(url)
    barrier.wait()
    done, begun = 0, time.perf_counter()
    for block in blocks[index::CORES]:
        assert catalogue.claim_block(block, "benchmark", 600)
        catalogue.finish(block, 1, BlockEnd(BlockState.done, repeatable=True))
        done += 2
        if time.perf_counter() - begun > SECONDS:
            break
    results.put(done / (time.perf_counter() - begun))


def store_blocks(barrier: Any, results: Any, index: int, folder: Path) -> None:
    """Store finished blocks of 32 points, durable on return."""
    layout = layout_of_study(the_study())
    count = layout.blocks[0][1]
    noise = np.random.default_rng(index).normal(size=(count, RECORD, len(layout.observables)))
    time_of = np.arange(float(RECORD))
    rows = tuple(SectionRows(p, 0, time_of, noise[p]) for p in range(count))
    ends = tuple(
        PointEnd(p, "", "", 1.0, np.empty((0, 4)), {"steps": 1.0}, {}) for p in range(count)
    )
    barrier.wait()
    done, begun, counts = 0, time.perf_counter(), Counter[str]()
    with counted(counts):
        while time.perf_counter() - begun < SECONDS:
            path = folder / f"{index}-{done}"
            create(path, layout)
            block = StudyBlock(path, layout, 0)
            block.take(StudySlice(1.0, tuple(range(count)), rows, ends))
            block.finish()
            done += 1
    results.put(counts["files"] / (time.perf_counter() - begun))


def capacities(folder: Path) -> dict[str, float]:
    """Return what one broker, one catalogue and one disk sustain, in things a second."""
    sent, taken = publishing_and_waking(folder / "service")
    url = f"sqlite:///{folder / 'catalogue.sqlite'}"
    catalogue = Catalogue(url)
    catalogue.migrate()
    job = submitted(catalogue, the_study())
    names = [block.id for block in catalogue.blocks(job)][:CORES]
    progress = rate(report_progress, url, names)
    many = NewJob("sweep", {}, "d" * 64, "0", blocks=tuple((64 * i, 64) for i in range(1562)))
    names = [block.id for block in catalogue.blocks(catalogue.submit(many).job.id)]
    ends = rate(begin_and_end, url, names)
    catalogue.close()
    return {
        "messages sent": sent,
        "messages acted on": taken,
        "progress": progress,
        "claims and ends": ends,
        "files": rate(store_blocks, folder),
    }


def batch_of_jobs(folder: Path) -> tuple[float, float, float]:
    """Seconds to submit a batch of 10 000 jobs, to ask how far it is, to cancel it."""
    catalogue = Catalogue(f"sqlite:///{folder / 'batch.sqlite'}")
    catalogue.migrate()
    study = the_study()
    jobs = [NewJob("simulate", study.job, study.digest, SOLVER_VERSION)] * BATCH
    begun = time.perf_counter()
    batch = catalogue.submit_batch(jobs).batch.id
    accepted = time.perf_counter()
    catalogue.batch(batch)
    asked = time.perf_counter()
    catalogue.cancel_batch(batch)
    cancelled = time.perf_counter()
    catalogue.close()
    return accepted - begun, asked - accepted, cancelled - asked


def main() -> None:
    """Print the table."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        demand(folder / "warm")
        counts, seconds = demand(folder / "counted")
        able = capacities(folder)
        submitting, asking, cancelling = batch_of_jobs(folder)
    scale = 1000 / VALUES
    core_seconds = seconds * scale
    ends = 2 * counts["messages"]
    busy = ends / able["claims and ends"] + (counts["writing"] - ends) / able["progress"]
    print(
        f"1000 values x {SETTLE + RECORD} periods of the press: {core_seconds:.0f} core seconds;"
        f" SQLite {sqlite3.sqlite_version}, {CORES} cores"
    )
    print(f"{'asked for':<38}{'per 1000 values':>16}{'sustained a second':>20}{'cores':>10}")
    for what, asked, sustained in (
        ("messages, relay to broker", counts["messages"], able["messages sent"]),
        ("messages, broker to workers", counts["messages"], able["messages acted on"]),
        ("writing transactions", counts["writing"], counts["writing"] / busy),
        ("files written", counts["files"], able["files"]),
    ):
        needed = asked * scale
        cores = sustained / (needed / core_seconds)
        print(f"{what:<38}{needed:>16.0f}{sustained:>20.0f}{cores:>10.0f}")
    for what, asked in (
        ("reading transactions (readers never wait)", counts["reading"]),
        ("waits for the disk", counts["syncs"]),
    ):
        print(f"{what:<42}{asked * scale:>12.0f}")
    print(f"{'bytes written':<42}{counts['bytes'] * scale / 1e6:>12.1f} MB")
    print(
        f"transactions of progress {able['progress']:.0f}/s; claims and ends"
        f" {able['claims and ends']:.0f}/s"
    )
    print(
        f"a batch of {BATCH} jobs: submitted in {submitting:.2f} s, looked at in"
        f" {1e3 * asking:.1f} ms, cancelled in {cancelling:.2f} s"
    )


if __name__ == "__main__":
    main()
