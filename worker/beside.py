"""Further blocks of a study for a worker that has one: a device computes many at a time."""

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import Block, Claim, Solver
from jointplay.storage.settings import Settings


def claim_beside(
    catalogue: Catalogue, settings: Settings, held: Block, solver: Solver, most: int
) -> list[Claim]:
    """Claim queued blocks of a held block's study for its worker, by index, and at most so many.

    With `most_running` the worker has no more of them than an owner may have computed.
    """
    worker = held.worker or ""
    if settings.most_running:
        most = min(most, settings.most_running - len(catalogue.held_by(worker)))
    wanted = catalogue.queued_of(held.job, max(most, 0))
    claims = (catalogue.claim_block(one, worker, settings.lease, solver) for one in wanted)
    return [claim for claim in claims if claim is not None]
