"""``/v1/worker/claims``: a block for a worker that has nothing to do, or comes back."""

import time
from dataclasses import replace
from importlib.metadata import version
from typing import Annotated

from fastapi import APIRouter, Request, Response
from fastapi.concurrency import run_in_threadpool

from jointplay.service.access import CallerDependency
from jointplay.service.dependencies import CatalogueDependency, SettingsDependency
from jointplay.service.problems import RequestRefused, kinds
from jointplay.service.vital import VitalDependency
from jointplay.service.workers.dependencies import (
    Attempt,
    BlockId,
    HeldBlock,
    document_of,
    own_name,
)
from jointplay.service.workers.new_blocks import NewBlocksDependency
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import Claim, WorkerDevice
from jointplay.worker.beside import claim_beside
from jointplay.worker.joined.protocol import (
    ClaimBeside,
    Claimed,
    ClaimedBeside,
    ClaimRequest,
    Customs,
)

router = APIRouter(prefix="/v1/worker", include_in_schema=False)
_FIRST_PAUSE, _LONGEST_PAUSE = 0.02, 0.5
"""Seconds between two looks for a block."""


@router.post("/claims", response_model=None)
async def claim_block(
    request: Request,
    catalogue: CatalogueDependency,
    settings: SettingsDependency,
    caller: CallerDependency,
    new_blocks: NewBlocksDependency,
    asked: Annotated[ClaimRequest, document_of(ClaimRequest)],
) -> Claimed | Response:
    """Answer with a block as soon as there is one that the worker's solver may compute.

    With 204 if there is none in the time that the worker waits.
    """
    _require_same_program(asked.program)
    worker = own_name(caller, asked.worker)
    await run_in_threadpool(_begin, catalogue, worker, asked, own_name(caller, ""))
    deadline = time.monotonic() + asked.wait
    pause = _FIRST_PAUSE
    while not await request.is_disconnected():
        claim = await run_in_threadpool(
            catalogue.claim_next_elsewhere,
            worker,
            settings.lease,
            asked.solver,
            most_running=settings.most_running,
        )
        if claim is not None:
            return Claimed(claim=_shown(claim), customs=Customs.of(settings))
        if time.monotonic() + pause > deadline:
            break
        announced = await new_blocks.wait(pause)
        pause = _FIRST_PAUSE if announced else min(1.5 * pause, _LONGEST_PAUSE)
    return Response(status_code=204)


@router.post("/blocks/{block}/{attempt}/beside")
def claim_blocks_beside(
    catalogue: CatalogueDependency,
    settings: SettingsDependency,
    held: HeldBlock,
    asked: Annotated[ClaimBeside, document_of(ClaimBeside)],
) -> ClaimedBeside:
    """Answer with blocks that wait of the study of one that is held, for a device."""
    found = claim_beside(catalogue, settings, held, asked.solver, asked.most, elsewhere=True)
    return ClaimedBeside(claims=tuple(map(_shown, found)))


@router.post("/blocks/{block}/{attempt}/cut-off", status_code=204)
async def note_cut_off(
    catalogue: CatalogueDependency,
    caller: CallerDependency,
    vital: VitalDependency,
    block: BlockId,
    attempt: Attempt,
) -> None:
    """Count the loss of an attempt no more: its worker lives, and could not reach the service."""
    await vital.run(catalogue.note_cut_off, block, attempt, own_name(caller, ""))


def _shown(claim: Claim) -> Claim:
    """Return a claim without its owner, and without the label that the catalogue has of it.

    The document is as the results have it: with the label that the job was submitted with.
    """
    return replace(claim, job=replace(claim.job, owner="", label=None))


def _begin(catalogue: Catalogue, worker: str, asked: ClaimRequest, of_key: str) -> None:
    """Note that the worker is there, and take back what it was given without hearing of it."""
    device = None if asked.device is None else WorkerDevice(**dict(asked.device))
    catalogue.note_worker(worker, asked.solver, device, of_key=of_key)
    if asked.spent:
        catalogue.note_spent(worker, asked.spent)
    for block in catalogue.held_by(worker):
        catalogue.release(block.id, block.attempt)


def _require_same_program(program: str) -> None:
    own = version("jointplay")
    if program.partition(".")[0] != own.partition(".")[0]:
        sentence = f"This service is jointplay {own}, and the worker {program}."
        raise RequestRefused(kinds.OTHER_VERSION, sentence)
