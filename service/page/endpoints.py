"""``/``, ``/docs``, ``/favicon.ico`` and ``/page/…``: HTML, styles and modules for browsers.

They are no part of the API: the OpenAPI document does not list them.
"""

from typing import Final

from fastapi import APIRouter, Request, Response

from jointplay.service.page.files import page_file
from jointplay.service.problems import RequestRefused, clipped, kinds

router = APIRouter(include_in_schema=False)

CONTENT_POLICY: Final = "; ".join(
    (
        "default-src 'none'",
        "script-src 'self'",
        "style-src 'self'",
        "img-src 'self' data: blob:",
        "media-src blob:",
        "connect-src 'self'",
        "base-uri 'none'",
        "form-action 'none'",
        "frame-ancestors 'none'",
    )
)
"""Nothing from elsewhere, no script or style inside HTML, no text that is made into a script."""
_HEADERS: Final = {
    "Content-Security-Policy": CONTENT_POLICY,
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cache-Control": "no-cache",  # asks again after an upgrade, and is told 304 otherwise
}


@router.api_route("/", methods=["GET", "HEAD"])
def show_page(request: Request) -> Response:
    """Show the page; its views are told apart by what follows ``#`` in the address."""
    return _file(request, "index.html")


@router.api_route("/docs", methods=["GET", "HEAD"])
def show_reference(request: Request) -> Response:
    """Show the reference of the API, made in the browser from ``/openapi.json``."""
    return _file(request, "reference/index.html")


@router.api_route("/favicon.ico", methods=["GET", "HEAD"])
def show_icon(request: Request) -> Response:
    """Show the icon that browsers ask for unasked."""
    return _file(request, "icon.ico")


@router.api_route("/page/{name:path}", methods=["GET", "HEAD"])
def show_file(request: Request, name: str) -> Response:
    """Show a style, module or picture of the page."""
    return _file(request, name)


def _file(request: Request, name: str) -> Response:
    found = page_file(name)
    if found is None:
        raise RequestRefused(kinds.NOT_FOUND, f"The page has no file {clipped(name)!r}.")
    headers = _HEADERS | {"ETag": f'"{found.digest}"'}
    if headers["ETag"] in request.headers.get("If-None-Match", ""):
        return Response(status_code=304, headers=headers)
    return Response(found.content, headers=headers, media_type=found.media_type)
