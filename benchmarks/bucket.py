"""Results in a bucket: objects, times and rates, and how far readers of a running job are behind.

    python -m benchmarks bucket [--samples 10000000 ...]

SeaweedFS on loopback, the catalogue SQLite. A press job is one revolution. Its results are packed,
which is the end of computing, and then published: sent, and told to the catalogue. Many of them
have no certificates. The long job is a pendulum, at which another process looks while it runs:
what is not in the last restart point is not seen, and is lost with the machine, so that readers are
as far behind as restart points are apart.  Its memory is what it takes beyond that of its start,
without pages of files.  Processor time is that of all processes, the store's among them.
"""

import argparse
import multiprocessing
import os
import statistics
import tempfile
import threading
import time
from collections import Counter
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path
from typing import Any

from benchmarks.latency import JOB
from benchmarks.memory import anonymous
from jointplay.chaos.inside import FOLDER_VARIABLE
from jointplay.chaos.processes import running
from jointplay.client import Client
from jointplay.service.processes import running_service
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import NewJob
from jointplay.storage.object_stores.s3 import Bucket
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.settings import Settings
from jointplay.worker.scratch.computing import compute
from tests.seaweedfs_server import BUCKET, running_store
from tests.waiting import processor_time

REPEATS, JOBS, WORKERS = 15, 100, 2
LOOK = 0.1  # s
TICKS = os.sysconf("SC_CLK_TCK")
LONG: dict[str, Any] = {
    "kind": "simulate",
    "scene": {"preset": "pendulum"},
    "output_step": 1e-4,
    "channels": ["rod.theta", "rod.omega", "pivot.force_x"],
    "certificate": False,
}


class Puts(Counter[str]):
    """Count of how often each key was put, of bytes, and when sealed results were packed."""

    size = 0
    packing, packed = 0.0, 0.0

    @contextmanager
    def counted(self) -> Iterator["Puts"]:
        """Count while it lasts."""
        put, replace = Bucket.put, Bucket.replace

        def measured(pieces: Iterable[bytes]) -> Iterator[bytes]:
            for piece in pieces:
                self.size += len(piece)
                yield piece

        def packing(pieces: Iterator[bytes]) -> Iterator[bytes]:
            yield from pieces
            self.packed = time.perf_counter()

        def counting_put(bucket: Bucket, key: str, pieces: Iterable[bytes]) -> None:
            self[key] += 1
            self.packing = time.perf_counter()
            put(bucket, key, packing(measured(pieces)))

        def counting_replace(bucket: Bucket, key: str, pieces: Iterable[bytes]) -> None:
            self[key] += 1
            replace(bucket, key, measured(pieces))

        Bucket.put = counting_put  # type: ignore[assignment, method-assign]
        Bucket.replace = counting_replace  # type: ignore[assignment, method-assign]
        try:
            yield self
        finally:
            Bucket.put, Bucket.replace = put, replace  # type: ignore[method-assign]


def submitted(catalogue: Catalogue, document: dict[str, Any]) -> str:
    """Queue a job and return its id."""
    admission = admit(document)
    assert isinstance(admission, Admission)
    new = NewJob("simulate", admission.job, admission.digest, SOLVER_VERSION)
    return catalogue.submit(new).job.id


def computed(settings: Settings, job: str) -> tuple[Puts, float]:
    """Compute a job here; return what was put, and the seconds until it was published."""
    catalogue = Catalogue(settings.catalogue_url)
    claim = catalogue.claim_block(f"{job}-0", "benchmark", settings.lease)
    assert claim is not None
    with Puts().counted() as puts:
        compute(catalogue, settings, claim, threading.Event())
    ended = time.perf_counter()
    assert catalogue.get(job).state == "succeeded"
    catalogue.close()
    return puts, ended - puts.packed


def press_jobs(settings: Settings, catalogue: Catalogue) -> None:
    """Print objects and times of single jobs."""
    document = {name: value for name, value in JOB.items() if name != "cache"}
    found = [computed(settings, submitted(catalogue, document)) for _ in range(REPEATS + 1)][1:]
    objects = max(len(puts) for puts, _ in found)
    size = statistics.median(puts.size for puts, _ in found) / 1e3
    packed = 1e3 * statistics.median(puts.packed - puts.packing for puts, _ in found)
    published = 1e3 * statistics.median(seconds for _, seconds in found)
    print(
        f"press job: {objects} objects, {size:.0f} kB, packed in {packed:.0f} ms and published in"
        f" {published:.0f} ms"
    )


def spent(folder: Path) -> Counter[str]:
    """Return the processor time of a service's processes by role, and of all there are, ms."""
    found = Counter({"all": round(1e3 * processor_time())})
    for process in running(folder):
        fields = Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        role = "worker" if process.role == "computing" else process.role
        found[role] += round(1e3 * (int(fields[11]) + int(fields[12])) / TICKS)
    return found


def many_jobs(folder: Path, address: str) -> str:
    """Return the jobs a second of a service, and the processor time of each, as a sentence."""
    environment = {"JOINTPLAY_RESULTS_URL": address, FOLDER_VARIABLE: str(folder)}
    with (
        running_service(folder / "data", WORKERS, environment) as url,
        Client(url) as client,
    ):
        for job in [client.submit(JOB) for _ in range(2 * WORKERS)]:
            job.wait()  # loads kernels
        begun, before = time.perf_counter(), spent(folder)
        batch = client.submit_batch([JOB | {"certificate": False}] * JOBS)
        batch.wait()
        rate, processor = JOBS / (time.perf_counter() - begun), spent(folder) - before
        parts = ", ".join(f"{role} {ms / JOBS:.0f}" for role, ms in processor.most_common())
        return f"{rate:.0f} jobs/s; ms of processor a job: {parts}"


def compute_long(settings: Settings, job: str, results: Any) -> None:
    """Compute in a process of its own, whose memory is then known."""
    before = anonymous(os.getpid())
    begun = time.perf_counter()
    puts, published = computed(settings, job)
    ended = time.perf_counter()
    packed = puts.packed - puts.packing
    results.put((len(puts), puts.size, ended - begun, packed, published, before))


def long_job(settings: Settings, catalogue: Catalogue, samples: int) -> None:
    """Print what a job of many samples takes, as it is seen by others meanwhile."""
    job = submitted(catalogue, LONG | {"duration": LONG["output_step"] * (samples - 1)})
    context = multiprocessing.get_context("spawn")
    results = context.Queue()
    process = context.Process(target=compute_long, args=(settings, job, results))
    process.start()
    moments, reading = list[tuple[float, int]](), list[float]()
    objects, memory = 0, 0.0
    while process.is_alive() and not catalogue.get(job).state.terminal:
        memory = max(memory, anonymous(process.pid or 0))
        (block,) = catalogue.blocks(job)
        if block.watermark and (not moments or moments[-1][1] != block.watermark):
            begun = time.perf_counter()
            moments.append((begun, block.watermark))
            reader = ResultReader(settings.running_run(job, 1), block.watermark)
            window = reader.history(["rod.theta"], start=block.watermark - 1000)
            assert len(window[0]) == 1000
            reading.append(time.perf_counter() - begun)
            objects = max(
                objects, sum(1 for _ in settings.object_store.list(f"running/{job[-2:]}/{job}/"))
            )
        time.sleep(LOOK)
    puts, size, seconds, packed, published, before = results.get(timeout=60)
    process.join()
    apart = [later - before for (before, _), (later, _) in pairwise(moments)]
    sealed = settings.sealed_run(job, 1).size()
    print(
        f"{samples} samples of {len(LONG['channels'])} channels: {seconds:.1f} s in all; at most"
        f" {objects} objects at a time, {puts} keys put, {size / 1e6:.0f} MB sent;"
        f" {sealed / 1e6:.0f} MB packed in {packed:.1f} s and published in {published:.1f} s,"
        f" {sealed / 1e6 / published:.0f} MB/s;"
        f" {memory - before:.0f} MB of memory"
    )
    if apart:
        print(
            f"restart points are {statistics.median(apart):.1f} s apart, at most"
            f" {max(apart):.1f} s; readers saw the last 1000 samples in"
            f" {1e3 * statistics.median(reading):.0f} ms"
        )


@contextmanager
def installation() -> Iterator[tuple[Settings, Catalogue]]:
    """Keep a store of its own for a while: long jobs would fill one that others use, too."""
    with tempfile.TemporaryDirectory() as folder, running_store() as endpoint:
        address = f"s3://{BUCKET}/one?endpoint={endpoint}"
        settings = Settings(data=Path(folder), results_url=address)
        catalogue = Catalogue(settings.catalogue_url)
        catalogue.migrate()
        yield settings, catalogue
        catalogue.close()


def main() -> None:
    """Print all of it."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks bucket")
    parser.add_argument(
        "--samples", type=int, nargs="+", default=[10_000_000], help="of long jobs, one a number"
    )
    samples = parser.parse_args().samples
    for number in samples:
        with installation() as (settings, catalogue):
            long_job(settings, catalogue, number)
    with installation() as (settings, catalogue):
        press_jobs(settings, catalogue)
    with tempfile.TemporaryDirectory() as name, running_store() as endpoint:
        folder, together = Path(name), f"s3://{BUCKET}/many?endpoint={endpoint}"
        for where, address in (("bucket", together), ("folder", f"file:{folder / 'results'}")):
            found = many_jobs(folder / where, address)
            print(f"{JOBS} press jobs, {WORKERS} workers, {where}: {found}")
        print(f"load of the machine {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")


if __name__ == "__main__":
    main()
