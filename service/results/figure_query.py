"""Query of a figure: what it shows, and the options of its page, as figures have them."""

from typing import Any, Literal

from pydantic import Field, create_model

from jointplay.figures import Options
from jointplay.records.page_option import OPTIONS, Option
from jointplay.service.fields import in_unit
from jointplay.service.results.queries import TimeOrPoints


class FigureSelection(TimeOrPoints):
    """Selection of what a figure shows."""

    joints: str | None = Field(
        default=None,
        max_length=2000,
        description="Clearance joints, separated by commas; default: all.",
    )

    over: str | None = Field(
        default=None,
        max_length=200,
        description="Id of a chart, basins or, of branches, a diagram, which lies beneath.",
    )

    def options(self) -> Options:
        """Return the options of the page; `NotDrawable` if one cannot be."""
        return Options(**{name: getattr(self, name) for name in OPTIONS})


def _field(option: Option) -> tuple[Any, Any]:
    """Return type and meaning of an option's parameter."""
    description = f"{option.help}."
    if option.choices:
        return Literal[option.choices] | None, Field(default=None, description=description)
    if option.is_text:
        return str | None, Field(default=None, max_length=int(option.most), description=description)
    bounds: dict[str, Any] = {"default": None, "ge": option.least, "le": option.most}
    if option.unit:
        return float | None, in_unit(option.unit, description, **bounds)
    return float | None, Field(description=description, **bounds)


PAGE_FIELDS: dict[str, Any] = {name: _field(option) for name, option in OPTIONS.items()}
"""Fields of the page's options, as `create_model` takes them."""
FigureQuery = create_model("FigureQuery", __base__=FigureSelection, **PAGE_FIELDS)
