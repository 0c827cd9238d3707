"""Conditions of requests on what a client has already (RFC 9110, sections 13.1.1 and 13.1.2)."""

from fastapi import Request

from jointplay.service.problems import RequestRefused, kinds


def has(request: Request, tag: str) -> bool:
    """Whether If-None-Match names an entity tag, or any; compared weakly, as is done there.

    Raises
    ------
    RequestRefused
        412: If-Match names other tags; compared strongly.
    """
    wanted = _listed(request, "if-match")
    if wanted and "*" not in wanted and tag not in wanted:
        sentence = f"The entity tag is {tag}, and If-Match does not name it."
        raise RequestRefused(kinds.PRECONDITION_FAILED, sentence, headers={"ETag": tag})
    listed = _listed(request, "if-none-match")
    return "*" in listed or tag.removeprefix("W/") in [one.removeprefix("W/") for one in listed]


def _listed(request: Request, header: str) -> list[str]:
    """Return the tags that a header names, in all its lines; none if there is no such header."""
    lines = request.headers.getlist(header)
    return [one.strip() for line in lines for one in line.split(",")]
