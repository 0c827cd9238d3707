"""``/v1/worker/blocks/{block}/{attempt}/files``: what a worker reads and writes of a block."""

import tempfile
from base64 import b64encode
from collections.abc import Iterator
from contextlib import suppress
from hashlib import sha256
from typing import IO, Annotated, Final

from fastapi import APIRouter, Path, Query, Request, Response
from fastapi.concurrency import run_in_threadpool
from fastapi.responses import StreamingResponse

from jointplay.service.dependencies import CatalogueDependency, SettingsDependency
from jointplay.service.problems import RequestRefused, kinds
from jointplay.service.workers.words import HeldBlock
from jointplay.storage.attempt_files import AttemptFiles
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Fenced
from jointplay.storage.catalogue.records import Block
from jointplay.storage.settings import Settings
from jointplay.worker.joined.protocol import File, Files
from jointplay.worker.removal import withdraw

router = APIRouter(prefix="/v1/worker/blocks/{block}/{attempt}/files", include_in_schema=False)
LARGEST_FILE: Final = 2**34
_PIECE: Final = 2**20
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
    except ValueError as error:
        raise _no_file(name, error) from error
    except FileNotFoundError:
        raise RequestRefused(kinds.NOT_FOUND, f"The block has no file {name!r}.") from None
    return StreamingResponse(_rest(first, pieces), media_type="application/octet-stream")


@router.put("/{name:path}", status_code=204)
async def write_file(
    request: Request,
    catalogue: CatalogueDependency,
    settings: SettingsDependency,
    held: HeldBlock,
    name: Name,
    offset: Offset = None,
) -> None:
    """Store a file whole, or what it has from an offset on, once its digest was found right."""
    length = request.headers.get("content-length", "")
    if not length.isdecimal() or int(length) > LARGEST_FILE:
        sentence = f"Content-Length is missing, or more than {LARGEST_FILE} bytes."
        raise RequestRefused.of_parameter("Content-Length", sentence)
    if settings.room() < int(length):
        sentence = "The disk of the service is full but for a reserve."
        raise RequestRefused(kinds.DISK_FULL, sentence, headers={"Retry-After": "30"})
    with tempfile.TemporaryFile(dir=settings.data) as content:
        digest, left = sha256(), int(length)
        async for piece in request.stream():
            left -= len(piece)
            if left < 0:  # sent in chunks, for which Content-Length says nothing
                sentence = f"The file has more than the {length} bytes of Content-Length."
                raise RequestRefused.of_parameter("Content-Length", sentence)
            digest.update(piece)
            content.write(piece)
        expected = f"sha-256=:{b64encode(digest.digest()).decode()}:"
        if request.headers.get("content-digest") != expected:
            sentence = "Content-Digest, sha-256, is missing, or not that of the bytes that arrived."
            raise RequestRefused.of_parameter("Content-Digest", sentence)
        content.seek(0)
        await run_in_threadpool(_store, catalogue, settings, held, name, offset, content)


@router.delete("/{name:path}", status_code=204)
def remove_file(settings: SettingsDependency, held: HeldBlock, name: Name) -> None:
    """Remove a file that the attempt has replaced by others."""
    try:
        AttemptFiles(settings, held).remove(name)
    except ValueError as error:
        raise _no_file(name, error) from error


def _store(
    catalogue: Catalogue,
    settings: Settings,
    held: Block,
    name: str,
    offset: int | None,
    content: IO[bytes],
) -> None:
    """Store, and remove it again if the job ended without the attempt meanwhile."""
    files = AttemptFiles(settings, held)
    pieces = iter(lambda: content.read(_PIECE), b"")
    try:
        if offset is None:
            files.put(name, pieces)
        else:
            files.append(name, offset, pieces)
    except (ValueError, FileNotFoundError) as error:
        raise _no_file(name, error) from error
    require_still_held(catalogue, settings, held)


def require_still_held(catalogue: Catalogue, settings: Settings, held: Block) -> None:
    """Raise `Fenced` if the block was lost while a file of it was stored, which is then removed."""
    try:
        catalogue.held(held.id, held.attempt)
    except Fenced:
        withdraw(catalogue, settings, held)
        raise


def _rest(first: bytes, pieces: Iterator[bytes]) -> Iterator[bytes]:
    yield first
    with suppress(FileNotFoundError):  # removed meanwhile: the answer ends too early
        yield from pieces


def _no_file(name: str, error: Exception) -> RequestRefused:
    return RequestRefused.of_parameter("name", f"{name!r} cannot be had or stored: {error}.")
