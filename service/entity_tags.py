"""Conditions of requests on what a client has already (RFC 9110, section 13.1.2)."""

from fastapi import Request


def has(request: Request, tag: str) -> bool:
    """Whether If-None-Match names an entity tag, or any; compared weakly, as is done there."""
    header = request.headers.get("if-none-match")
    listed = [] if header is None else [one.strip() for one in header.split(",")]
    return "*" in listed or tag.removeprefix("W/") in [one.removeprefix("W/") for one in listed]
