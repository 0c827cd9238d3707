"""``/v1/jobs/{id}/zarr.zip``: a job's sealed store in one file, from here or its bucket."""

from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path
from typing import Any, Final

from fastapi import APIRouter, Request, Response
from fastapi.responses import RedirectResponse

from jointplay.service import entity_tags
from jointplay.service.access.signed import SIGNED
from jointplay.service.dependencies import SettingsDependency
from jointplay.service.fields import BINARY
from jointplay.service.problems import RequestRefused, header, kinds, problems
from jointplay.service.results.stores import ResultsOfJob, ResultsOfThePath
from jointplay.service.streamed import Streamed
from jointplay.service.zarr import ranges
from jointplay.storage.errors import LostObject
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.object_stores.folder import Folder
from jointplay.storage.packed import Packed
from jointplay.storage.packed.ranges import OpenFile, Ranges

router = APIRouter(prefix="/v1/jobs/{job_id}", tags=["results"])

_TYPE: Final = "application/zip"
_PIECE: Final = 2**20
_LARGE: Final = 2**20
"""Bytes of a file that a bucket sends itself; of a smaller one the way there takes longer."""
_SIGNED_FOR: Final = 900.0  # s
_TAG: Final = {
    "ETag": header("Strong entity tag of the file."),
    "Accept-Ranges": header("`bytes`."),
}
_SERVED: dict[int | str, dict[str, Any]] = {
    200: {"description": "The file.", "headers": _TAG, "content": {_TYPE: BINARY}},
    206: {
        "description": "The bytes of the range.",
        "headers": _TAG | {"Content-Range": header("Which bytes of how many.")},
        "content": {_TYPE: BINARY},
    },
    304: {"description": "It is what If-None-Match names.", "headers": _TAG},
    307: {
        "description": "The bucket sends it; ask there, with the same range and without a key.",
        "headers": {"Location": header("Address that is signed for a quarter of an hour.")},
    },
}


@router.head("/zarr.zip", include_in_schema=False)
@router.get(
    "/zarr.zip",
    response_class=Response,
    responses=_SERVED
    | problems(
        *kinds.OF_A_JOB,
        kinds.NO_RESULTS,
        kinds.RESULTS_NOT_READY,
        kinds.DAMAGED_RESULTS,
        kinds.RANGE_NOT_SATISFIABLE,
        kinds.PRECONDITION_FAILED,
        kinds.INVALID_REQUEST,
    ),
)
def show_whole(
    request: Request, results: ResultsOfThePath, settings: SettingsDependency
) -> Response:
    """Return the job's sealed Zarr v3 store in one file, an uncompressed zip, or a range of it.

    All of it that is sent is compared with its checksums before; 410 if it is damaged.
    """
    sealed, version = results.sealed, _sealed_version(results)
    size = sealed.size()
    if settings.results_redirect and size >= _LARGE and request.method == "GET":
        address = sealed.object_store.link(sealed.key, settings.results_redirect, _SIGNED_FOR)
        if address is not None:
            return RedirectResponse(address, 307, {"Cache-Control": "no-store"})
    guarded = "authorization" in request.headers or SIGNED in request.scope
    headers = {
        "Accept-Ranges": "bytes",
        "Cache-Control": f"{'private' if guarded else 'public'}, no-cache",
        "ETag": f'"{sha256(version.encode()).hexdigest()[:32]}"',
    }
    if entity_tags.has(request, headers["ETag"]):
        return Response(status_code=304, headers=headers)
    asked = ranges.asked(request)
    unchanged = request.headers.get("if-range") in (None, headers["ETag"])
    try:
        part = ranges.window(asked if unchanged else None, size)
    except ranges.Unsatisfiable:
        raise ranges.refused(request, "The file", size) from None
    start, stop = part or (0, size)
    if part is not None:
        headers["Content-Range"] = f"bytes {start}-{stop - 1}/{size}"
    headers["Content-Length"] = str(stop - start)
    status = 206 if part else 200
    if request.method == "HEAD":
        return Response(b"", status, headers, _TYPE)
    source = _held(sealed)
    Packed(source).check(start, stop)  # whose directory is checked, too
    return Streamed(_pieces(source, start, stop), status, headers, _TYPE)


def _sealed_version(results: ResultsOfJob) -> str:
    """Return what changes with the file; refuse if there is none, or it is another job's."""
    job = results.job
    if results.whole() is not None and (version := results.sealed.version()) is not None:
        return version
    if not job.state.terminal:
        raise results.not_ready("its store is one file once it has ended")
    sentence = f"Job {job.id} is {job.state}, and its store was not sealed."
    raise RequestRefused(kinds.NO_RESULTS, sentence)


def _held(sealed: StoredObject) -> Ranges:
    """Return a store to be read to its end, as it is now, even if its job is deleted meanwhile.

    A bucket cannot keep it for that long.
    """
    if not isinstance(sealed.object_store, Folder):
        return sealed
    try:
        return OpenFile(str(sealed), Path(sealed.object_store.root) / sealed.key)
    except FileNotFoundError as error:
        raise LostObject(f"{sealed} was removed") from error


def _pieces(source: Ranges, start: int, stop: int) -> Iterator[bytes]:
    for begin in range(start, stop, _PIECE):
        yield source.read(begin, min(begin + _PIECE, stop))
