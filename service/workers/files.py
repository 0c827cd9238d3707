"""``/v1/worker/blocks/{block}/{attempt}/files``: what a worker reads and writes of a block."""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from itertools import chain
from typing import Annotated

from fastapi import APIRouter, Path, Query, Request, Response
from fastapi.concurrency import run_in_threadpool

from jointplay.service.dependencies import CatalogueDependency, SettingsDependency
from jointplay.service.problems import RequestRefused, kinds
from jointplay.service.streamed import Streamed
from jointplay.service.workers.dependencies import HeldBlock, JobOfBlock
from jointplay.service.workers.file_body import LARGEST_FILE, arrived, length_of
from jointplay.service.workers.handed_in import HandedIn
from jointplay.service.workers.uploads import UploadsDependency
from jointplay.storage.attempt_files import AttemptFiles
from jointplay.worker.joined.protocol import File, Files
from jointplay.worker.transient_faults import is_full

router = APIRouter(prefix="/v1/worker/blocks/{block}/{attempt}/files", include_in_schema=False)
Name = Annotated[str, Path(max_length=300)]
Offset = Annotated[int | None, Query(ge=0, le=LARGEST_FILE)]


@router.get("")
def list_files(settings: SettingsDependency, held: HeldBlock) -> Files:
    """List what the attempt builds on."""
    found = AttemptFiles(settings, held).needed()
    return Files(files=tuple(File(name=name, size=size) for name, size in found))


@router.get("/{name:path}", response_model=None)
def read_file(settings: SettingsDependency, held: HeldBlock, name: Name) -> Response:
    """Return one of them."""
    pieces = AttemptFiles(settings, held).read(name)
    try:
        first = next(pieces, b"")
    except (ValueError, IsADirectoryError, NotADirectoryError) as error:
        raise _no_file(name, error) from error
    except FileNotFoundError:
        raise RequestRefused(kinds.NOT_FOUND, f"The block has no file {name!r}.") from None
    return Streamed(chain((first,), pieces), media_type="application/octet-stream")


@router.put("/{name:path}", status_code=204)
async def write_file(
    request: Request,
    catalogue: CatalogueDependency,
    settings: SettingsDependency,
    uploads: UploadsDependency,
    held: HeldBlock,
    job: JobOfBlock,
    name: Name,
    offset: Offset = None,
) -> None:
    """Store a file whole, or what it has from an offset on, once its digest was found right."""
    length = length_of(request)
    handed_in = HandedIn(catalogue, settings, job, held)
    with _naming(name), ExitStack() as stack:
        sending = handed_in.sending(uploads, name, length, offset)
        await run_in_threadpool(stack.enter_context, sending)
        kept = stack.enter_context(uploads.room(settings, length))
        async with arrived(request, settings.data, kept) as content:
            await run_in_threadpool(handed_in.store, name, offset, content)


@router.delete("/{name:path}", status_code=204)
def remove_file(
    catalogue: CatalogueDependency,
    settings: SettingsDependency,
    held: HeldBlock,
    job: JobOfBlock,
    name: Name,
) -> None:
    """Remove a file that the attempt has replaced by others."""
    with _naming(name):
        HandedIn(catalogue, settings, job, held).remove(name)


@contextmanager
def _naming(name: str) -> Iterator[None]:
    """Refuse what cannot be done with a file of a name."""
    try:
        yield
    except (ValueError, FileNotFoundError, IsADirectoryError, NotADirectoryError) as error:
        raise _no_file(name, error) from error
    except OSError as fault:
        if not is_full(fault):
            raise
        sentence = "The disk of the service is full."
        raise RequestRefused(kinds.DISK_FULL, sentence, headers={"Retry-After": "30"}) from fault


def _no_file(name: str, error: Exception) -> RequestRefused:
    return RequestRefused.of_parameter("name", f"{name!r} cannot be had or stored: {error}.")
