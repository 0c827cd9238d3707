"""``/v1/jobs/{id}/zarr/…``: a job's store as it is stored, for stock Zarr clients."""

import gzip
import json
from typing import Annotated, Any, Final

from fastapi import APIRouter, Path, Request, Response

from jointplay.service import entity_tags
from jointplay.service.access.signed import SIGNED
from jointplay.service.compression import takes_gzip
from jointplay.service.fields import BINARY
from jointplay.service.problems import ErrorDetail, RequestRefused, clipped, header, kinds, problems
from jointplay.service.results.stores import ResultsOfThePath
from jointplay.service.zarr import ranges
from jointplay.service.zarr.contents import Content, content_of, former_content, is_key
from jointplay.storage.catalogue.records import Job

router = APIRouter(prefix="/v1/jobs/{job_id}/zarr", tags=["results"])

_DOCUMENT: Final = "zarr.json"
_FOREVER: Final = "max-age=31536000, immutable"
_TAG: Final = {
    "ETag": header("Strong entity tag of the key's bytes."),
    "Cache-Control": header("`no-cache`, or `immutable` once the job is finished."),
    "Accept-Ranges": header("`bytes`."),
}
_SERVED: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "The bytes of the key.",
        "headers": _TAG,
        "content": {
            "application/octet-stream": BINARY,
            "application/json": {"schema": {"type": "object"}},
        },
    },
    206: {
        "description": "The bytes of the range.",
        "headers": _TAG | {"Content-Range": header("Which bytes of how many.")},
        "content": {
            "application/octet-stream": BINARY,
            "application/json": BINARY,
        },
    },
    304: {"description": "It is what If-None-Match names.", "headers": _TAG},
}


@router.get(
    "",
    responses=problems(*kinds.OF_A_JOB, kinds.NOT_FOUND, kinds.INVALID_REQUEST),
)
def show_root(results: ResultsOfThePath) -> dict[str, Any]:
    """Return the metadata of the whole store, which Zarr clients read from `/zarr/zarr.json`."""
    content = content_of(results, _DOCUMENT)
    if content is None:
        raise _nothing_at(results.job, _DOCUMENT)
    root: dict[str, Any] = json.loads(content.read(0, content.size))
    return root


@router.head("/{key:path}", include_in_schema=False)
@router.get(
    "/{key:path}",
    response_class=Response,
    responses=_SERVED
    | problems(
        *kinds.OF_A_JOB,
        kinds.NOT_FOUND,
        kinds.RANGE_NOT_SATISFIABLE,
        kinds.PRECONDITION_FAILED,
        kinds.INVALID_REQUEST,
    ),
)
def show_stored(
    request: Request,
    results: ResultsOfThePath,
    key: Annotated[str, Path(description="Key of the Zarr store, such as `zarr.json`.")],
) -> Response:
    """Return one key of the job's Zarr v3 store, or a range of its bytes.

    Open the address up to `/zarr` with any Zarr client: `xarray.open_zarr(".../zarr")`.  While
    the job runs it shows what has been committed; once it is finished everything may be cached
    for ever.
    """
    # the router drops a newline after the key
    exact = request.scope["path"].endswith(f"/zarr/{key}")
    content = content_of(results, key) if exact and is_key(key) else None
    if content is None:
        raise _nothing_at(results.job, key)
    try:
        try:
            return _answer(request, key, content)
        except ranges.Unsatisfiable:
            former = former_content(results, key, content)
            if former is None:
                raise
            return _answer(request, key, former)
    except ranges.Unsatisfiable:
        raise ranges.refused(request, key, content.size) from None


def _answer(request: Request, key: str, content: Content) -> Response:
    guarded = "authorization" in request.headers or SIGNED in request.scope
    whose = "private" if guarded else "public"
    headers = {
        "Accept-Ranges": "bytes",
        "Cache-Control": f"{whose}, {_FOREVER}" if content.final else "no-cache",
    }
    media_type = "application/octet-stream"
    asked = ranges.asked(request)
    if key.endswith(_DOCUMENT):
        media_type = "application/json"
        headers["Vary"] = "Accept-Encoding"
        if asked is None and takes_gzip(request.headers.get("accept-encoding", "")):
            packed = gzip.compress(content.read(0, content.size), 6, mtime=0)
            tag = f'{content.tag[:-1]}-gzip"'
            content = Content(len(packed), tag, lambda start, stop: packed[start:stop])
            headers["Content-Encoding"] = "gzip"
    headers["ETag"] = content.tag
    if entity_tags.has(request, content.tag):
        return Response(status_code=304, headers=headers)
    condition = request.headers.get("if-range")
    part = ranges.window(asked if condition in (None, content.tag) else None, content.size)
    start, stop = part or (0, content.size)
    if part is not None:
        headers["Content-Range"] = f"bytes {start}-{stop - 1}/{content.size}"
    headers["Content-Length"] = str(stop - start)
    body = b"" if request.method == "HEAD" else content.read(start, stop)
    return Response(body, 206 if part else 200, headers, media_type)


def _nothing_at(job: Job, key: str) -> RequestRefused:
    sentence = f"The store of job {job.id} has no {clipped(key)!r}"
    if not job.state.terminal:
        sentence += f"; the job is {job.state}, and what it commits appears here"
    errors = [ErrorDetail(parameter="key", detail=f"{sentence}.")]
    return RequestRefused(kinds.NOT_FOUND, f"{sentence}.", errors)
