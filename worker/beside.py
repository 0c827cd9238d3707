"""Further blocks of a study for a worker that has one: a device computes many at a time."""

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Unavailable
from jointplay.storage.catalogue.records import Block, Claim, Solver
from jointplay.storage.settings import Settings

MOST_BLOCKS = 256
"""Blocks that a worker holds at a time: each has a thread for its lease, and restart points."""


def claim_beside(
    catalogue: Catalogue,
    settings: Settings,
    held: Block,
    solver: Solver,
    most: int,
    *,
    elsewhere: bool = False,
) -> list[Claim]:
    """Claim queued blocks of a held block's study for its worker, by index, and at most so many.

    With them it holds no more than `MOST_BLOCKS`, and `most_running` of the job's owner are
    computed, but for those that others claim at the same moment. `elsewhere` : the worker goes on
    where this machine ends.

    Raises
    ------
    Unavailable
        The catalogue is out of reach, and nothing was claimed.
    """
    worker = held.worker or ""
    most = min(most, MOST_BLOCKS - len(catalogue.held_by(worker)))
    claim_block = catalogue.claim_block_elsewhere if elsewhere else catalogue.claim_block
    claims = list[Claim]()
    try:
        for one in catalogue.queued_of(held.job, most, settings.most_running):
            claim = claim_block(one, worker, settings.lease, solver)
            claims += [] if claim is None else [claim]
    except Unavailable:
        if not claims:  # those that were claimed are not left to end with their leases
            raise
    return claims
