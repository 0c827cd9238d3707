"""Forms of an answer that programs read: JSON, CSV, NPZ, MATLAB or Arrow, as Accept asks."""

import io
import re
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Annotated, Any, Final, cast

import numpy as np
from fastapi import Depends, Request, Response
from numpy.typing import NDArray

from jointplay.records.text_tables import csv_lines
from jointplay.service.fields import BINARY
from jointplay.service.problems import RequestRefused, clipped, kinds

JSON = "application/json"
CSV = "text/csv"
NPZ = "application/x-npz"
MATLAB = "application/x-matlab-data"
ARROW = "application/vnd.apache.arrow.stream"
_EXTRA = (ARROW,) if find_spec("pyarrow") else ()  # comes with the extra `arrow`
FORMS: Final[tuple[str, ...]] = (JSON, CSV, NPZ, MATLAB, *_EXTRA)
_SUFFIX: Final = {CSV: "csv", NPZ: "npz", MATLAB: "mat", ARROW: "arrows"}
_LONGEST_FIELD: Final = 63  # of a name in MATLAB
_OF_A_PARENT: Final = "value"
AS_FILES: Final[dict[int | str, dict[str, Any]]] = {
    200: {
        "content": {
            form: {"schema": {"type": "string"}} if form == CSV else BINARY for form in FORMS[1:]
        }
    }
}
"""The forms of an answer beside JSON, for the OpenAPI document."""


@dataclass(frozen=True)
class Column:
    """A quantity over the rows of a table, or with `part` its minimum or maximum."""

    name: str
    unit: str
    values: NDArray[Any]
    part: str = ""

    @property
    def label(self) -> str:
        """Name in flat tables."""
        return f"{self.name}_{self.part}" if self.part else self.name


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
    content = {CSV: _csv, NPZ: _npz, MATLAB: _matlab, ARROW: _arrow}[form](columns, complete)
    headers = {"Content-Disposition": f'attachment; filename="{name}.{_SUFFIX[form]}"'}
    media_type = f"{form}; charset=utf-8; header=present" if form == CSV else form
    return Response(content, headers=headers, media_type=media_type)


def _csv(columns: list[Column], complete: bool) -> bytes:
    del complete  # has no place in a table
    titles = [f"{column.label} [{column.unit}]" for column in columns]
    return "".join(csv_lines(titles, [[column.values for column in columns]])).encode()


def _npz(columns: list[Column], complete: bool) -> bytes:
    file = io.BytesIO()
    named: dict[str, Any] = {column.label: column.values for column in columns}
    units = np.array([[column.label, column.unit] for column in columns])
    np.savez(file, **named, units=units, complete=np.array(complete))
    return file.getvalue()


def _matlab(columns: list[Column], complete: bool) -> bytes:
    """Give nested structs: channel `slider7.x` is the field `x` of the variable `slider7`."""
    from scipy.io import savemat  # loads much of scipy

    values: dict[str, Any] = {}
    units: dict[str, Any] = {}
    for column in columns:
        path = [*column.name.split("."), *([column.part] if column.part else [])]
        _place(values, path, column.values.reshape(-1, 1))
        _place(units, column.name.split("."), column.unit)
    file = io.BytesIO()
    document = values | {"units": units, "complete": complete}
    savemat(cast(Any, file), document, long_field_names=True, oned_as="column")
    return file.getvalue()


def _arrow(columns: list[Column], complete: bool) -> bytes:
    import pyarrow  # is there only with the extra

    fields = [
        pyarrow.field(column.label, pyarrow.float64(), metadata={"unit": column.unit})
        for column in columns
    ]
    schema = pyarrow.schema(fields, metadata={"complete": str(complete).lower()})
    table = pyarrow.table([column.values for column in columns], schema=schema)
    stream = pyarrow.BufferOutputStream()
    with pyarrow.ipc.new_stream(stream, schema) as writer:
        writer.write_table(table)
    return bytes(stream.getvalue())


def _place(tree: dict[str, Any], path: list[str], leaf: object) -> None:
    """Put a leaf at a path; where a node is a leaf as well, that goes into its `value`."""
    *parents, last = (_field(part) for part in path)
    for parent in parents:
        below = tree.setdefault(parent, {})
        if not isinstance(below, dict):
            below = tree[parent] = {_OF_A_PARENT: below}
        tree = below
    if isinstance(tree.get(last), dict):
        tree[last][_OF_A_PARENT] = leaf
    else:
        tree[last] = leaf


def _field(name: str) -> str:
    """Make a name that MATLAB takes."""
    field = re.sub(r"\W", "_", name, flags=re.ASCII)
    return (field if field[:1].isalpha() else f"x{field}")[:_LONGEST_FIELD]


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
        )
    return form


Form = Annotated[str, Depends(_form)]
"""Media type of the answer (RFC 9110, section 12.5.1); 406 if the client takes none of them."""
