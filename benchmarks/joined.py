"""The diagram of `sweep` by two workers over HTTPS alone, beside two workers of the service itself.

    python -m benchmarks joined [--values 80] [--turns 15]

Two services on this machine take turns, so that what else the machine does slows both alike: one
with two workers, one without and two that joined with an address; each is the first in every second
turn. Kernels are warm. The last lines are medians and quartiles over the turns of local time by
joined time; processor time is that of all processes of both services and their workers, which a
machine with other things to do does not stretch.
"""

import argparse
import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path
from subprocess import DEVNULL

from benchmarks.sweep import VALUES, document
from jointplay.client import Client
from jointplay.service.processes import running_service
from tests.waiting import processor_time

WORKERS, TURNS = 2, 7


@contextmanager
def joined_worker(url: str, environment: Mapping[str, str] | None = None) -> Iterator[None]:
    """Keep a worker running that knows the address alone."""
    command = [sys.executable, "-P", "-m", "jointplay", "worker", "--join", url]
    with subprocess.Popen(command, env=environment, stdout=DEVNULL, stderr=DEVNULL) as worker:
        try:
            yield
        finally:
            worker.terminate()


def seconds_of(client: Client, values: int) -> tuple[float, float]:
    """Return the time from the request to the end of one diagram, and the processor's."""
    begun, used = time.perf_counter(), processor_time()
    job = client.submit(document(values) | {"cache": False}).wait()
    if job.state != "succeeded":
        raise SystemExit(f"the job {job.state}: {job.error}")
    return time.perf_counter() - begun, processor_time() - used


def main() -> None:
    """Print the times of every turn, and the ratio."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks joined")
    parser.add_argument("--values", type=int, default=VALUES, help="clearances of the diagram")
    parser.add_argument("--turns", type=int, default=TURNS, help="of each service, 2 or more")
    asked = parser.parse_args()
    values = asked.values
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        local = stack.enter_context(running_service(folder / "local", WORKERS))
        served = stack.enter_context(running_service(folder / "joined", 0))
        for _ in range(WORKERS):
            stack.enter_context(joined_worker(served))
        clients = [stack.enter_context(Client(url)) for url in (local, served)]
        for client in clients:
            seconds_of(client, values)  # loads kernels
        turns = []
        for turn in range(asked.turns):
            first = turn % 2
            took = {which: seconds_of(clients[which], values) for which in (first, 1 - first)}
            turns.append((took[0], took[1]))
            (one, its), (other, others) = turns[-1]
            line = f"local {one:.2f} s ({its:.2f} s of processor)"
            print(f"{line}, joined {other:.2f} s ({others:.2f} s of processor)", flush=True)
    print(f"load of the machine {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
    for number, what in enumerate(("time", "processor time")):
        ratios = [one[number] / other[number] for one, other in turns]
        low, middle, high = statistics.quantiles(ratios, method="inclusive")
        print(f"ratio of {what} {middle:.3f}, quartiles {low:.3f} and {high:.3f}")


if __name__ == "__main__":
    main()
