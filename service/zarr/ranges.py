"""Byte ranges of requests (RFC 9110, section 14)."""

import re
from typing import Final

from fastapi import Request

from jointplay.service.problems import RequestRefused, clipped, kinds

_SINGLE: Final = re.compile(
    r"bytes=(?:(\d{1,19})-(\d{0,19})|-(\d{1,19}))", re.ASCII | re.IGNORECASE
)


class Unsatisfiable(Exception):
    """The range has no byte of the content."""


def asked(request: Request) -> str | None:
    """Return the Range header of a GET; for other methods it has no meaning."""
    return request.headers.get("range") if request.method == "GET" else None


def window(header: str | None, size: int) -> tuple[int, int] | None:
    """Return first byte and the one after the last that a Range header means.

    Parameters
    ----------
    header
        The header's value. Several ranges, other units and nonsense mean the whole, as the
        standard allows.
    size
        Bytes of the whole.

    Returns
    -------
    tuple
        None for the whole.

    Raises
    ------
    Unsatisfiable
        The range begins behind the last byte, or is a suffix of no byte.
    """
    matched = _SINGLE.fullmatch(header.replace(" ", "")) if header else None
    if matched is None:
        return None
    if matched[3]:
        start, stop = max(size - int(matched[3]), 0), size
    else:
        start = int(matched[1])
        stop = min(int(matched[2]) + 1, size) if matched[2] else size
        if matched[2] and int(matched[2]) < start:
            return None
    if start >= stop:
        raise Unsatisfiable
    return start, stop


def refused(request: Request, name: str, size: int) -> RequestRefused:
    """Return the refusal of a range that has no byte of what is named."""
    given = clipped(request.headers.get("range", ""))
    return RequestRefused(
        kinds.RANGE_NOT_SATISFIABLE,
        f"{name} has {size} bytes, and none of them is in the range {given!r}.",
        headers={"Content-Range": f"bytes */{size}", "Accept-Ranges": "bytes"},
    )
