"""One block that is computed in this process, against a real catalogue."""

import threading

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import Block, JobState
from jointplay.storage.settings import Settings
from jointplay.worker.block_run import BlockRun

JOB = {
    "kind": "simulate",
    "scene": {"preset": "seven-bar-press"},
    "duration": 20.0,
    "channels": ["slider7.*"],
}


def run(
    catalogue: Catalogue, settings: Settings, block: str, *, draining: bool = False
) -> tuple[JobState, Block]:
    """Claim and compute a block; return what became of the job, and of the block."""
    claim = catalogue.claim_block(block, "this process", settings.lease)
    assert claim is not None
    asked = threading.Event()
    if draining:
        asked.set()
    BlockRun(catalogue, settings, claim, asked).run()
    return catalogue.get(claim.job.id).state, catalogue.blocks(claim.job.id)[claim.block.index]
