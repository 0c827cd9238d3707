"""``/v1/worker/blocks/{block}/{attempt}/drops``: files that a worker puts into the bucket."""

from typing import Annotated, Final

from fastapi import APIRouter, Response

from jointplay.service.dependencies import CatalogueDependency, SettingsDependency
from jointplay.service.problems import RequestRefused
from jointplay.service.workers.dependencies import HeldBlock, JobOfBlock, document_of
from jointplay.service.workers.handed_in import HandedIn
from jointplay.service.workers.uploads import UploadsDependency
from jointplay.worker.joined.protocol import Drop, DropAt

router = APIRouter(prefix="/v1/worker/blocks/{block}/{attempt}/drops", include_in_schema=False)
_SIGNED_FOR: Final = 900.0  # s
DropMessage = Annotated[Drop, document_of(Drop)]


@router.post("", response_model=None)
def offer(
    catalogue: CatalogueDependency,
    settings: SettingsDependency,
    uploads: UploadsDependency,
    held: HeldBlock,
    job: JobOfBlock,
    message: DropMessage,
) -> DropAt | Response:
    """Return where a file of so many bytes may be put, or 204 if it is to be sent here.

    What is put there is no file of the job: an attempt that is late changes nothing.
    """
    address = None
    if settings.results_redirect:
        try:
            dropped = HandedIn(catalogue, settings, job, held).offered(
                uploads, message.name, message.sha256, message.size, _SIGNED_FOR
            )
        except ValueError as error:
            raise _refused(error) from error
        if dropped is not None:
            address = dropped.object_store.link_to_put(
                dropped.key, settings.results_redirect, _SIGNED_FOR, message.size
            )
    return Response(status_code=204) if address is None else DropAt(address=address)


@router.post("/taken", status_code=204)
def take(
    catalogue: CatalogueDependency,
    settings: SettingsDependency,
    held: HeldBlock,
    job: JobOfBlock,
    message: DropMessage,
) -> None:
    """Make a file of the job of what was put, once its bytes were found right."""
    try:
        HandedIn(catalogue, settings, job, held).take(
            message.name, message.sha256, message.size, message.md5
        )
    except (ValueError, FileNotFoundError) as error:
        raise _refused(error) from error


def _refused(error: Exception) -> RequestRefused:
    return RequestRefused.of_parameter("name", f"The file is not taken: {error}.")
