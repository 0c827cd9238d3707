"""``/``, ``/docs``, ``/report``, ``/favicon.ico``, ``/page/…``: HTML, styles and modules.

They are no part of the API: the OpenAPI document does not list them.
"""

import re
from typing import Final

from fastapi import APIRouter, Request, Response

from jointplay.service import entity_tags
from jointplay.service.dependencies import SettingsDependency
from jointplay.service.page.files import (
    VERSION_LENGTH,
    PageFile,
    page_file,
    report_file,
    version,
)
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
REPORT_POLICY: Final = "; ".join(
    (
        "default-src 'none'",
        "style-src 'unsafe-inline'",
        "img-src data:",
        "base-uri 'none'",
        "form-action 'none'",
        "frame-ancestors 'none'",
        "sandbox",
    )
)
"""A document with its own style and pictures, in which nothing is carried out or loaded."""
_HEADERS: Final = {
    "Referrer-Policy": "no-referrer",
    "Vary": "Accept-Encoding",  # as compressed ones say, and 304 must say what they do
    "Cache-Control": "no-cache",  # asks again after an upgrade, and is told 304 otherwise
}
_FOREVER: Final = {"Cache-Control": "public, max-age=31536000, immutable"}
_VERSIONED: Final = re.compile(rf"([0-9a-f]{{{VERSION_LENGTH}}})/(.+)")


@router.get("/")
def show_page(request: Request) -> Response:
    """Show the page; its views are told apart by what follows ``#`` in the address."""
    return _file(request, "index.html")


@router.get("/docs")
def show_reference(request: Request) -> Response:
    """Show the reference of the API, made in the browser from ``/openapi.json``."""
    return _file(request, "reference/index.html")


@router.get("/favicon.ico")
def show_icon(request: Request) -> Response:
    """Show the icon that browsers ask for unasked."""
    return _file(request, "icon.ico")


@router.get("/page/{name:path}")
def show_file(request: Request, name: str) -> Response:
    """Show a style, module or picture of the page.

    HTML names them with their version, and modules one another beside themselves, so that browsers
    ask for each once. Under another version, as between two APIs during an upgrade, it is not kept.
    """
    versioned = _VERSIONED.fullmatch(name)
    if versioned is None:
        return _file(request, name)
    answer = _file(request, versioned[2])
    if versioned[1] == version():
        answer.headers.update(_FOREVER)
    return answer


@router.get("/report")
def show_report(request: Request, settings: SettingsDependency) -> Response:
    """Show the reproduction's report, as it was written, or how to make one."""
    found = report_file(settings.report)
    return (
        _file(request, "report/index.html")
        if found is None
        else _sent(request, found, REPORT_POLICY)
    )


def _file(request: Request, name: str) -> Response:
    found = page_file(name)
    if found is None:
        raise RequestRefused(kinds.NOT_FOUND, f"The page has no file {clipped(name)!r}.")
    return _sent(request, found, CONTENT_POLICY)


def _sent(request: Request, found: PageFile, policy: str) -> Response:
    headers = _HEADERS | {"ETag": f'"{found.digest}"', "Content-Security-Policy": policy}
    if entity_tags.has(request, headers["ETag"]):
        return Response(status_code=304, headers=headers)
    return Response(found.content, headers=headers, media_type=found.media_type)
