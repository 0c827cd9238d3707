"""``/v1/worker/blocks/{block}/{attempt}``: what a worker says of the block that it holds."""

from typing import Annotated

from fastapi import APIRouter

from jointplay.service.dependencies import CatalogueDependency, SettingsDependency
from jointplay.service.problems import RequestRefused
from jointplay.service.vital import VitalDependency
from jointplay.service.workers.dependencies import (
    HELD,
    Attempt,
    BlockId,
    HeldBlock,
    JobOfBlock,
    document_of,
)
from jointplay.service.workers.handed_in import HandedIn
from jointplay.service.workers.new_blocks import NewBlocksDependency
from jointplay.storage.catalogue.records import BlockEnd
from jointplay.worker.joined import protocol
from jointplay.worker.joined.protocol import Answered, Finished
from jointplay.worker.removal import tidy
from jointplay.worker.wake_up import wake_relay

router = APIRouter(
    prefix="/v1/worker/blocks/{block}/{attempt}", dependencies=[HELD], include_in_schema=False
)


@router.post("/heartbeat")
async def heartbeat(
    catalogue: CatalogueDependency,
    settings: SettingsDependency,
    vital: VitalDependency,
    block: BlockId,
    attempt: Attempt,
) -> Answered:
    """Hold the block longer."""
    verdict = await vital.run(catalogue.heartbeat, block, attempt, settings.lease)
    return Answered(verdict=verdict)


@router.post("/progress")
async def record_progress(
    catalogue: CatalogueDependency,
    settings: SettingsDependency,
    vital: VitalDependency,
    block: BlockId,
    attempt: Attempt,
    message: Annotated[protocol.Progress, document_of(protocol.Progress)],
) -> Answered:
    """Note how far the block is, and hold it longer."""
    known = message.model_dump()
    verdict = await vital.run(catalogue.record_progress, block, attempt, settings.lease, **known)
    return Answered(verdict=verdict)


@router.post("/checkpoint")
async def record_checkpoint(
    catalogue: CatalogueDependency,
    settings: SettingsDependency,
    vital: VitalDependency,
    block: BlockId,
    attempt: Attempt,
    message: Annotated[protocol.Checkpoint, document_of(protocol.Checkpoint)],
) -> Answered:
    """Name a restart point, whose files are there; with its progress the block is held longer."""
    point = message.model_dump(exclude={"progress"})
    await vital.run(catalogue.record_checkpoint, block, attempt, **point)
    if message.progress is None:
        return Answered(verdict=await vital.run(catalogue.verdict, block, attempt))
    return await record_progress(catalogue, settings, vital, block, attempt, message.progress)


@router.post("/activity", status_code=204)
def note_activity(
    catalogue: CatalogueDependency,
    block: BlockId,
    attempt: Attempt,
    message: Annotated[protocol.Busy, document_of(protocol.Busy)],
) -> None:
    """Show what takes long."""
    catalogue.note_activity(block, attempt, message.activity)


@router.post("/release", status_code=204)
def release(catalogue: CatalogueDependency, block: BlockId, attempt: Attempt) -> None:
    """Take the block back; it is not a loss."""
    catalogue.release(block, attempt)


@router.post("/put-off", status_code=204)
def put_off(
    catalogue: CatalogueDependency,
    block: BlockId,
    attempt: Attempt,
    message: Annotated[protocol.Activity, document_of(protocol.Activity)],
) -> None:
    """Take the block back until a fault of the worker has passed."""
    catalogue.put_off(block, attempt, message.activity)


@router.post("/finish")
def finish(
    catalogue: CatalogueDependency,
    settings: SettingsDependency,
    new_blocks: NewBlocksDependency,
    held: HeldBlock,
    job: JobOfBlock,
    message: Annotated[protocol.Finish, document_of(protocol.Finish)],
) -> Finished:
    """End the block, if its results are there, and, with its last block, the job."""
    HandedIn(catalogue, settings, job, held).require_end(message.outcome, message.steps)
    try:
        state = catalogue.finish(held.id, held.attempt, BlockEnd(**dict(message)))
    except ValueError as error:
        raise RequestRefused.of_parameter("outcome", f"{error}.") from error
    if settings.most_running:  # its owner may have another block computed
        wake_relay(settings.redis_url)
        new_blocks.announce(1)
    if state.terminal:
        tidy(settings, held)
    return Finished(state=state)
