"""Times until work goes on that a fault has stopped, and until a machine works again."""

import time
from concurrent.futures import Future, ThreadPoolExecutor

from sqlalchemy import func, select

from jointplay.chaos.recovery import PATIENCE, Recovery
from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Unavailable
from jointplay.storage.catalogue.records import Block, BlockState, JobState
from tests.machines.cluster import WORKERS, Cluster
from tests.machines.machine import Machine

_LOOK = 0.2  # s
_threads = ThreadPoolExecutor(4, "recovery")


def is_of(machine: Machine | None, block: Block) -> bool:
    """Whether a worker of a machine, or of any, has a block."""
    if block.state is not BlockState.running or block.worker is None:
        return False
    name = block.worker.rpartition("@")[2]  # before it is the key of one that joined
    return machine is None or name.startswith(f"{machine.name}:")


def taken_over(cluster: Cluster, machine: Machine) -> "tuple[int, Future[float | None]]":
    """Return how many blocks a machine has, and soon the time until all of them go on [s].

    What waits because the workers elsewhere have other blocks does not count.
    """
    catalogue = Catalogue(cluster.settings.catalogue_url)
    elsewhere = WORKERS * (len(cluster.machines) - 1)
    recovery = Recovery(catalogue, elsewhere, lambda block: is_of(machine, block))
    return len(recovery.held), _threads.submit(recovery.wait, time.monotonic())


def started(cluster: Cluster, machine: Machine, since: float) -> "Future[float | None]":
    """Return soon the time until all processes of a machine that was booted are there [s]."""

    def there() -> bool:
        try:
            workers = sum(machine.boot in name for name in catalogue.workers())
        except Unavailable:
            return False
        return workers >= WORKERS and (machine is cluster.joined or machine.answers())

    def wait() -> float | None:
        try:
            while time.monotonic() - since < PATIENCE:
                if there():
                    return time.monotonic() - since
                time.sleep(_LOOK)  # nothing tells when all processes are there
            return None
        finally:
            catalogue.close()

    catalogue = Catalogue(cluster.settings.catalogue_url)
    return _threads.submit(wait)


def lost(catalogue: Catalogue) -> int:
    """Count the attempts that lost their block; 0 while the catalogue does not answer."""
    attempt = tables.attempt
    count = select(func.count()).select_from(attempt).where(attempt.c.outcome == "lost")
    try:
        with catalogue.connections.reading() as connection:
            return int(connection.execute(count).scalar_one())
    except Unavailable:
        return 0


def back(cluster: Cluster, machine: Machine, since: float) -> float | None:
    """Return the time until a machine's workers have come further, or nothing waits for them [s].

    None: they never did.
    """
    catalogue = Catalogue(cluster.settings.catalogue_url)
    first: dict[str, tuple[int, float]] | None = None
    try:
        while time.monotonic() - since < PATIENCE:
            try:
                blocks = _open_blocks(catalogue)
            except Unavailable:
                time.sleep(_LOOK)  # nothing tells when the database is back
                continue
            now = {one.id: (one.attempt, one.progress_fraction) for one in blocks}
            first = now if first is None else first
            waits = any(one.state is BlockState.queued for one in blocks)
            here = [one for one in blocks if is_of(machine, one)]
            if any(first.get(one.id) != now[one.id] for one in here) or not (here or waits):
                return time.monotonic() - since
            time.sleep(_LOOK)  # the times that are reported are as fine as this
        return None
    finally:
        catalogue.close()


def _open_blocks(catalogue: Catalogue) -> list[Block]:
    jobs = catalogue.jobs(limit=1000).jobs
    live = [job.id for job in jobs if job.state in (JobState.queued, JobState.running)]
    return [block for job in live for block in catalogue.blocks(job)]
