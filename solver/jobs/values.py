"""The values that a parameter takes: a list, or a range with a count and a spacing."""

from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from jointplay.solver.quantities.units import Strict
from jointplay.solver.scene.unions import form, told_by

UNIT = {"unit": "the parameter's unit"}


class Range(Strict):
    """`count` values from the first to the last, both included, in equal steps or equal ratios."""

    start: Annotated[float, Field(alias="from", json_schema_extra=UNIT)]
    stop: Annotated[float, Field(alias="to", json_schema_extra=UNIT)]
    count: Annotated[
        int, Field(ge=1, le=10**12, description="number of values", json_schema_extra={"unit": "1"})
    ]
    spacing: Annotated[
        Literal["linear", "log"],
        Field(description="linear: equal steps; log: equal ratios, for values of one sign"),
    ] = "linear"


def _form_of_values(value: Any) -> str | None:
    if isinstance(value, list):
        return "list"
    return "range" if isinstance(value, dict | Range) else None


Values = Annotated[
    Annotated[Range, form("range")]
    | Annotated[
        list[Annotated[float, Field(json_schema_extra=UNIT)]], Field(min_length=1), form("list")
    ],
    told_by(
        _form_of_values,
        "The values must be a list of numbers, or an object with 'from', 'to' and 'count'",
    ),
]


def count(values: Range | list[float]) -> int:
    """Return how many values there are, without making them."""
    return values.count if isinstance(values, Range) else len(values)


def numbers(values: Range | list[float]) -> NDArray[np.float64]:
    """Return the values, (count,); a range hits both its ends exactly."""
    if not isinstance(values, Range):
        return np.array(values, np.float64)
    spaced = np.linspace if values.spacing == "linear" else np.geomspace
    return spaced(values.start, values.stop, values.count, dtype=np.float64)
