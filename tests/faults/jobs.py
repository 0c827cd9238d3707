"""Jobs put straight into the catalogue, and what tests of faults wait for."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

from jointplay.solver.kinds import Admission
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import Block, BlockState, Job, NewJob
from jointplay.storage.settings import Settings
from tests.waiting import until

IMPATIENT = {
    "JOINTPLAY_LEASE": "3",  # six heartbeats: a machine busy with other tests may swallow some
    "JOINTPLAY_HEARTBEAT": "0.5",
    "JOINTPLAY_REAPER_PERIOD": "0.2",
    "JOINTPLAY_PROGRESS_PERIOD": "0.2",
    "JOINTPLAY_REPUBLISH_AFTER": "1",
    "JOINTPLAY_MAX_ATTEMPTS": "10",
}


class Service(NamedTuple):
    """An impatient service with two workers, which several tests harm one after the other."""

    settings: Settings
    catalogue: Catalogue


def submit(catalogue: Catalogue, admission: Admission) -> str:
    new = NewJob("simulate", admission.job, admission.digest, SOLVER_VERSION)
    return catalogue.submit(new).job.id


def standing(catalogue: Catalogue, job: str) -> object:
    """Return what changes while a worker has a job: leases, attempts, progress."""
    return catalogue.get(job).state, catalogue.blocks(job)


def ended(catalogue: Catalogue, job: str) -> Job:
    until(lambda: catalogue.get(job).state.terminal, progress=lambda: standing(catalogue, job))
    return catalogue.get(job)


def in_mid_block(catalogue: Catalogue, job: str, index: int = 0, after: float = 0.0) -> Block:
    """Wait until a worker has a block, has passed a fraction of it and left a restart point."""

    def is_there() -> bool:
        block = catalogue.blocks(job)[index]
        over = block.state is BlockState.done or catalogue.get(job).state.terminal
        assert not over, "it ended before anything could happen"
        held = block.lease_until is not None and block.checkpoint is not None
        return held and block.progress_fraction > after

    until(is_there, progress=lambda: standing(catalogue, job))
    return catalogue.blocks(job)[index]


def pid_of(block: Block) -> int:
    assert block.worker is not None
    return int(block.worker.split(":")[1])


def api_of(data: Path) -> list[int]:
    """Return the process id of the API of a service."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            command = (entry / "cmdline").read_bytes().decode().split("\0")
            variables = (entry / "environ").read_bytes().decode()
        except OSError:
            continue
        is_api = "jointplay.service.processes.api" in command and "-P" in command
        if is_api and f"JOINTPLAY_DATA={data}\0" in f"{variables}\0":
            found.append(int(entry.name))
    return found


@contextmanager
def catalogue_of(settings: Settings) -> Iterator[Catalogue]:
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    yield catalogue
    catalogue.close()
