"""Catalogue of the laws in the registries, as documents: for the API, the command line, readers."""

import inspect
import re
from collections.abc import Iterator, Mapping
from typing import Any, Literal, get_args, get_origin

from pydantic import BaseModel, Field
from pydantic.fields import FieldInfo

from jointplay.records.failure import InvalidInput
from jointplay.records.suggestions import unknown
from jointplay.solver.laws.contact import LAWS as CONTACT
from jointplay.solver.laws.delivered import ASKED, DELIVERED
from jointplay.solver.laws.dissipation import LAWS as DISSIPATION
from jointplay.solver.laws.force import ELEMENTS as FORCE
from jointplay.solver.laws.friction import LAWS as FRICTION
from jointplay.solver.laws.function import FUNCTIONS as FUNCTION
from jointplay.solver.laws.stiffness import LAWS as STIFFNESS
from jointplay.solver.quantities.registry import MemberOf
from jointplay.solver.quantities.units import Strict

FAMILIES: dict[str, Mapping[str, type[Strict]]] = {
    "contact": CONTACT,
    "stiffness": STIFFNESS,
    "dissipation": DISSIPATION,
    "friction": FRICTION,
    "force": FORCE,
    "function": FUNCTION,
}
TAGS = ("law", "type")


class LawParameter(BaseModel):
    """A parameter of a law."""

    name: str
    unit: str = Field(description="1 for pure numbers; empty where the value is no number.")
    help: str
    required: bool
    default: float | str | None = None
    minimum: float | None = None
    above: float | None = Field(None, description="The value must be larger than this.")
    maximum: float | None = None
    below: float | None = Field(None, description="The value must be smaller than this.")
    choices: list[str] | None = None


class DeliveredRestitution(BaseModel):
    """Restitution in free impacts, beside the one that is asked for; shares of the speed."""

    asked: list[float]
    delivered: list[float]
    command: str = "python -m benchmarks restitution"


class Law(BaseModel):
    """A member of a registry."""

    family: Literal["contact", "stiffness", "dissipation", "friction", "force", "function"]
    name: str
    formula: str
    text: str = Field(description="The symbols, in SI units.")
    assumes: str
    fails: str
    source: str
    parameters: list[LawParameter]
    latches: bool = Field(description="Whether it keeps the impact rate of each onset.")
    restitution: DeliveredRestitution | None = None


def laws(name: str | None = None) -> list[Law]:
    """Return every law, or those of one name or of one family.

    Raises
    ------
    InvalidInput
        There is no law and no family of that name.
    """
    found = [
        _law(family, *member) for family, members in FAMILIES.items() for member in members.items()
    ]
    if name is None:
        return found
    chosen = [law for law in found if name in (law.family, law.name)]
    if not chosen:
        known = [*FAMILIES, *(law.name for law in found)]
        raise InvalidInput.at("NAME", unknown("law", name, known))
    return chosen


def _law(family: Any, name: str, model: type[Strict]) -> Law:
    formula, *paragraphs = [
        " ".join(part.split()) for part in (inspect.getdoc(model) or "").split("\n\n")
    ]
    text = " ".join(part for part in paragraphs if not part.startswith("Source:"))
    source = " ".join(part for part in paragraphs if part.startswith("Source:"))
    symbols, assumes, fails = re.split(r"(?=\bAssumes )|(?=\bFails )", text, maxsplit=2)
    damping = name if family == "dissipation" or name in CONTACT else ""
    return Law(
        family=family,
        name=name,
        formula=formula.rstrip("."),
        text=symbols.strip(),
        assumes=assumes.strip(),
        fails=fails.strip(),
        source=source.removeprefix("Source: "),
        parameters=list(_parameters(model)),
        latches="impact_rate_floor" in model.model_fields,
        restitution=DeliveredRestitution(asked=list(ASKED), delivered=list(DELIVERED[damping]))
        if damping in DELIVERED
        else None,
    )


def _parameters(model: type[Strict]) -> Iterator[LawParameter]:
    for name, field in model.model_fields.items():
        if name in TAGS:
            continue
        extra = field.json_schema_extra if isinstance(field.json_schema_extra, dict) else {}
        bounds = {key: _bound(field, key) for key in ("ge", "gt", "le", "lt")}
        registries = [item for item in field.metadata if isinstance(item, MemberOf)]
        literals = (field.annotation, *get_args(field.annotation))
        words = (get_args(one) for one in literals if get_origin(one) is Literal)
        choices = [str(word) for word in next(words, ())] or None
        help_of_registry = f"a law of the family '{name}'" if registries else ""
        yield LawParameter(
            name=name,
            unit=str(extra.get("unit", "")),
            help=field.description or help_of_registry,
            required=field.is_required(),
            default=None if field.is_required() else field.default,
            minimum=bounds["ge"],
            above=bounds["gt"],
            maximum=bounds["le"],
            below=bounds["lt"],
            choices=choices,
        )


def _bound(field: FieldInfo, kind: str) -> float | None:
    return next((float(getattr(m, kind)) for m in field.metadata if hasattr(m, kind)), None)
