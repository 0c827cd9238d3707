"""Submissions and claims a second that SQLite and PostgreSQL sustain, waiting for the disk.

``python -m benchmarks catalogue [--seconds S]``. Submissions have a key and look for a job that
asks for the same, as those of the API do; APIs and claimants are processes. Processor time is that
of the clients.
"""

import argparse
import multiprocessing
import os
import secrets
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing, contextmanager, suppress
from pathlib import Path
from typing import Any

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Unavailable
from jointplay.storage.catalogue.records import NewJob, SubmissionKey
from tests.postgresql_server import running_server

PROCESSES = multiprocessing.get_context("fork")
CLAIMANTS, CLAIMS = 32, 2000


def new() -> NewJob:
    spec = {"scene": {"preset": "press"}, "duration": 2.0, "channels": ["*"] * 10, "x": "x" * 1500}
    return NewJob("simulate", spec, secrets.token_hex(32), "0.1.0+abc", scene="press")


def submitting(url: str, threads: int, seconds: float) -> list[float]:
    """Return how long each submission took, s."""
    took: list[float] = []
    with closing(Catalogue(url)) as catalogue, ThreadPoolExecutor(threads) as pool:
        catalogue.ping()
        end = time.monotonic() + seconds

        def submit(_: int) -> None:
            while time.monotonic() < end:
                began = time.perf_counter()
                catalogue.submit(new(), SubmissionKey(secrets.token_hex(8), "f"), reuse=True)
                took.append(time.perf_counter() - began)

        list(pool.map(submit, range(threads)))
    return took


def claimed(catalogue: Catalogue, block: str) -> bool:
    """Claim a block, unless others held the database for too long."""
    with suppress(Unavailable):
        return catalogue.claim_block(block, "worker", 30.0) is not None
    return False


def claiming(url: str, blocks: Sequence[str]) -> list[float]:
    """Return how long each claim took, s."""
    took = []
    with closing(Catalogue(url)) as catalogue:
        catalogue.ping()
        for block in blocks:
            began = time.perf_counter()
            while not claimed(catalogue, block):
                pass
            took.append(time.perf_counter() - began)
    return took


def measure(name: str, act: Callable[..., list[float]], *arguments: tuple[Any, ...]) -> None:
    """Print what processes do at once, each with its arguments."""
    results = PROCESSES.Queue()

    def run(given: tuple[Any, ...]) -> None:
        before = time.process_time()
        results.put((act(*given), time.process_time() - before))

    begun = time.monotonic()
    running = [PROCESSES.Process(target=run, args=(given,)) for given in arguments]
    for process in running:
        process.start()
    found = [results.get() for _ in running]
    lasted = time.monotonic() - begun
    for process in running:
        process.join()
    took = sorted(seconds for some, _ in found for seconds in some)
    processor = sum(seconds for _, seconds in found) / len(took)
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
            with closing(Catalogue(url)) as catalogue:
                jobs = catalogue.submit_batch([new() for _ in range(CLAIMS)]).jobs
            blocks = [f"{job}-0" for job in jobs]
            for claimants in (1, CLAIMANTS):
                some = blocks[: CLAIMS // 3] if claimants == 1 else blocks[CLAIMS // 3 :]
                parts = [(url, some[first::claimants]) for first in range(claimants)]
                measure(f"claims, {claimants} claimants", claiming, *parts)


if __name__ == "__main__":
    main()
