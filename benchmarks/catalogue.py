"""Submissions, claims and blocks a second that SQLite and PostgreSQL sustain, with their disk.

``python -m benchmarks catalogue [--seconds S]``. Submissions have a key and look for a job that
asks for the same, as those of the API do. Claims are of the block whose turn it is, among those of
four owners, just submitted; other workers claim blocks, advance once, and are done with them. APIs
and workers are processes, which begin together once each has done it for the first time. Processor
time is that of the clients.
"""

import argparse
import multiprocessing
import os
import secrets
import tempfile
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing, contextmanager, suppress
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Unavailable
from jointplay.storage.catalogue.records import (
    Block,
    BlockEnd,
    BlockState,
    NewJob,
    Solver,
    SubmissionKey,
)
from tests.postgresql_server import running_server

PROCESSES = multiprocessing.get_context("fork")
CLAIMANTS, CLAIMS = 32, 50
OWNERS = ("ada", "bob", "eve", "")
SOLVER = Solver("0.1.0+abc", "x86")
Ready = Callable[[], object]
Given = ParamSpec("Given")
Answer = TypeVar("Answer")


def new(owner: str = "") -> NewJob:
    spec = {"scene": {"preset": "press"}, "duration": 2.0, "channels": ["*"] * 10, "x": "x" * 1500}
    digest = secrets.token_hex(32)
    return NewJob("simulate", spec, digest, SOLVER.version, scene="press", owner=owner)


def submitting(ready: Ready, url: str, threads: int, seconds: float) -> list[float]:
    """Return how long each submission took, s."""
    took: list[float] = []
    with closing(Catalogue(url)) as catalogue, ThreadPoolExecutor(threads) as pool:
        catalogue.submit(new())
        ready()
        end = time.monotonic() + seconds

        def submit(_: int) -> None:
            while time.monotonic() < end:
                began = time.perf_counter()
                catalogue.submit(new(), SubmissionKey(secrets.token_hex(8), "f"), reuse=True)
                took.append(time.perf_counter() - began)

        list(pool.map(submit, range(threads)))
    return took


def claim(catalogue: Catalogue) -> Block:
    """Claim a block."""
    while True:  # others may be quicker
        claimed = again(catalogue.claim_next, f"worker {os.getpid()}", 30.0, SOLVER)
        if claimed is not None:
            return claimed.block


def compute(catalogue: Catalogue) -> None:
    """Claim a block, advance, and be done with it."""
    block = claim(catalogue)
    again(catalogue.record_progress, block.id, block.attempt, 30.0, time=1.0, fraction=0.5)
    again(catalogue.finish, block.id, block.attempt, BlockEnd(BlockState.done, time=2.0, steps=9))


def again(ask: Callable[Given, Answer], *given: Given.args, **named: Given.kwargs) -> Answer:
    """Return an answer of the database, asked again where others held it for too long."""
    while True:
        with suppress(Unavailable):
            return ask(*given, **named)


def working(ready: Ready, url: str, count: int, act: Callable[[Catalogue], object]) -> list[float]:
    """Return how long each claim, or each block, took, s."""
    took = []
    with closing(Catalogue(url)) as catalogue:
        act(catalogue)
        ready()
        for _ in range(count):
            began = time.perf_counter()
            act(catalogue)
            took.append(time.perf_counter() - began)
    return took


def measure(name: str, act: Callable[..., list[float]], *arguments: tuple[Any, ...]) -> None:
    """Print what processes do at once, each with its arguments."""
    results = PROCESSES.Queue()
    together = PROCESSES.Barrier(len(arguments))

    def run(given: tuple[Any, ...]) -> None:
        begun: list[tuple[float, float]] = []

        def ready() -> None:
            together.wait()
            begun.append((time.monotonic(), time.process_time()))

        took = act(ready, *given)
        ((since, before),) = begun
        results.put((took, since, time.monotonic(), time.process_time() - before))

    running = [PROCESSES.Process(target=run, args=(given,)) for given in arguments]
    for process in running:
        process.start()
    parts, began, ended, spent = zip(*[results.get() for _ in running], strict=True)
    lasted = max(ended) - min(began)
    for process in running:
        process.join()
    took = sorted(seconds for some in parts for seconds in some)
    processor = sum(spent) / len(took)
    print(
        f"  {name:34} {len(took) / lasted:5.0f} a second,"
        f" median {1e3 * took[len(took) // 2]:4.0f} ms,"
        f" 99th percentile {1e3 * took[int(0.99 * len(took))]:5.0f} ms,"
        f" {1e3 * processor:.1f} ms of processor"
    )


@contextmanager
def databases() -> Iterator[dict[str, str]]:
    with tempfile.TemporaryDirectory() as folder, running_server(fsync=True) as server:
        file = f"sqlite:///{Path(folder) / 'catalogue.sqlite'}"
        with closing(Catalogue(file)) as catalogue:
            catalogue.migrate()
        yield {"SQLite": file, "PostgreSQL": server.new()}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=5.0, help="of each measurement")
    seconds: float = parser.parse_args().seconds
    with databases() as urls:
        for name, url in urls.items():
            print(f"{name}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}")
            measure("submissions, 1 API, 32 threads", submitting, (url, 32, seconds))
            measure("submissions, 2 APIs, 16 threads", submitting, *[(url, 16, seconds)] * 2)
            for what, act in (("claims", claim), ("blocks", compute)):
                for workers in (1, CLAIMANTS):
                    with closing(Catalogue(url)) as catalogue:
                        for owner in OWNERS:
                            some = [new(owner) for _ in range(CLAIMANTS * CLAIMS // len(OWNERS))]
                            catalogue.submit_batch(some, owner=owner)
                    share = CLAIMANTS // workers * CLAIMS - 1
                    measure(f"{what}, {workers} workers", working, *[(url, share, act)] * workers)


if __name__ == "__main__":
    main()
