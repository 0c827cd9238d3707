"""Negotiation of the form of an answer (RFC 9110, section 12.5.1)."""

from collections.abc import Sequence
from importlib.util import find_spec
from typing import Annotated

from fastapi import Depends, Request

from jointplay.service.problems import RequestRefused, kinds
from jointplay.service.problems.document import clipped


def preferred(accept: str | None, offered: Sequence[str]) -> str | None:
    """Return the media type among those offered that an Accept header likes best.

    Parameters
    ----------
    accept
        The header's value; none takes anything.
    offered
        Media types; the first is preferred among equals.

    Returns
    -------
    str | None
        None if the header rules all of them out.
    """
    if accept is None or not accept.strip():
        return offered[0]
    weights: dict[str, float] = {}
    for one in accept.lower().split(","):
        media_range, *parameters = (part.strip() for part in one.split(";"))
        weights[media_range] = _quality(parameters)

    def weight(media_type: str) -> float:
        whole_family = f"{media_type.partition('/')[0]}/*"
        for media_range in (media_type, whole_family, "*/*"):
            if media_range in weights:
                return weights[media_range]
        return 0.0

    best = max(offered, key=weight)
    return best if weight(best) > 0.0 else None


def _quality(parameters: Sequence[str]) -> float:
    for parameter in parameters:
        name, _, value = parameter.partition("=")
        if name.strip() == "q":
            try:
                return min(max(float(value), 0.0), 1.0)
            except ValueError:
                return 0.0
    return 1.0


JSON = "application/json"
CSV = "text/csv"
NPZ = "application/x-npz"
MATLAB = "application/x-matlab-data"
ARROW = "application/vnd.apache.arrow.stream"
_EXTRA = (ARROW,) if find_spec("pyarrow") else ()  # comes with the extra `arrow`
FORMS = (JSON, CSV, NPZ, MATLAB, *_EXTRA)


async def _form(request: Request) -> str:
    accept = ",".join(request.headers.getlist("accept")) or None
    form = preferred(accept, FORMS)
    if form is None:
        raise RequestRefused(
            kinds.NOT_ACCEPTABLE,
            f"Accept is {clipped(accept or '')!r}; this answer is there as {', '.join(FORMS)}.",
        )
    return form


Form = Annotated[str, Depends(_form)]
"""Media type of the answer; refused with 406 if the client takes none that there is."""
