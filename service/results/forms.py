"""Forms of an answer that programs read, as Accept asks: JSON, or a table in a file."""

from collections.abc import AsyncIterator
from importlib.util import find_spec
from types import ModuleType
from typing import Annotated, Any, Final

from fastapi import Depends, Request, Response

from jointplay.records.table_files import Column, arrow, csv, matlab, npz, parquet
from jointplay.service.dependencies import of_the_application
from jointplay.service.fair_semaphore import FairSemaphore, slot_for
from jointplay.service.fields import BINARY
from jointplay.service.problems import RequestRefused, clipped, kinds

JSON = "application/json"
CSV, NPZ, MATLAB, ARROW, PARQUET = (form.MEDIA_TYPE for form in (csv, npz, matlab, arrow, parquet))
_FILES: Final[dict[str, ModuleType]] = {
    form.MEDIA_TYPE: form
    for form in (csv, npz, matlab, arrow, parquet)
    if form.NEEDS is None or find_spec(form.NEEDS)
}
FORMS: Final[tuple[str, ...]] = (JSON, *_FILES)
AS_FILES: Final[dict[int | str, dict[str, Any]]] = {
    200: {
        "content": {
            form: {"schema": {"type": "string"}} if form == CSV else BINARY for form in FORMS[1:]
        }
    }
}
"""The forms of an answer beside JSON, for the OpenAPI document."""


VARY: Final = {"Vary": "Accept"}
"""Header of all these answers: caches must not give one form for another."""


def as_file(form: str, name: str, columns: list[Column], *, complete: bool) -> Response:
    """Give a table as a file of the form.

    Parameters
    ----------
    form
        Media type, not JSON.
    name
        Of the file, without what it ends with.
    columns
        All of one length.
    complete
        Whether the run came to its end; in all files but CSV.
    """
    found = _FILES[form]
    content = found.encode(columns, complete=complete)
    headers = VARY | {"Content-Disposition": f'attachment; filename="{name}{found.SUFFIXES[0]}"'}
    media_type = f"{form}; charset=utf-8; header=present" if form == CSV else form
    return Response(content, headers=headers, media_type=media_type)


def weights_of(header: str) -> dict[str, float]:
    """Return how much a header such as Accept likes each of the things it lists, 0 to 1."""
    weights = {}
    for one in header.lower().split(","):
        listed, *parameters = (part.strip() for part in one.split(";"))
        weights[listed] = 1.0
        for parameter in parameters:
            name, _, value = parameter.partition("=")
            if name.strip() == "q":
                try:
                    weights[listed] = min(max(float(value), 0.0), 1.0)
                except ValueError:
                    weights[listed] = 0.0
    return weights


async def _form(request: Request) -> str:
    accept = ",".join(request.headers.getlist("accept"))
    weights = weights_of(accept) if accept.strip() else {"*/*": 1.0}

    def weight(form: str) -> float:
        ranges = form, f"{form.partition('/')[0]}/*", "*/*"
        return next((weights[one] for one in ranges if one in weights), 0.0)

    form = max(FORMS, key=weight)  # the first among equals
    if weight(form) == 0.0:
        raise RequestRefused(
            kinds.NOT_ACCEPTABLE,
            f"Accept is {clipped(accept)!r}; this answer is there as {', '.join(FORMS)}.",
            headers=VARY,
        )
    return form


Form = Annotated[str, Depends(_form)]
"""Media type of the answer (RFC 9110, section 12.5.1); 406 if the client takes none of them."""


async def _turn(
    request: Request,
    form: Form,
    exporting: Annotated[FairSemaphore, of_the_application("exporting")],
) -> AsyncIterator[None]:
    if form == JSON:
        yield
        return
    async with slot_for(request, exporting):
        yield


IN_TURN: Final = Depends(_turn, scope="function")
"""Has a slot while a file is made, and no longer: a client may take it slowly."""
