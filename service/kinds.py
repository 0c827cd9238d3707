"""``/v1/kinds``: the kinds of jobs and the fields of their documents, for forms."""

from functools import cache
from typing import Literal

from fastapi import APIRouter
from pydantic import BaseModel, Field

from jointplay.solver.kinds import KINDS
from jointplay.solver.kinds.description import description

router = APIRouter(prefix="/v1/kinds", tags=["jobs"])
Form = Literal[
    "number",
    "integer",
    "flag",
    "text",
    "names",
    "numbers",
    "values",
    "grid",
    "axis",
    "distributions",
    "section",
    "other",
]


class JobField(BaseModel):
    """A field of a job's document."""

    help: str
    form: Form = Field(
        description="Of its value; values: a list or a range, grid: values by parameter, axis: a "
        "parameter and its values, distributions: a distribution by parameter, section: where "
        "sections are taken."
    )
    unit: str | None = None
    choices: list[str] = Field(default=[], description="Values that there are.")
    words: list[str] = Field(default=[], description="Words that may stand in place of a value.")
    members: dict[str, list[str]] = Field(
        default={},
        description="Of distributions, the numbers that each is made of; of a section, the fields"
        " of each of its forms.",
    )
    varied: list[Literal["parameter", "start"]] = Field(
        default=[],
        description="What an axis or a distribution may be of: a parameter of the scene, by its"
        " name, or a number of its start, by its JSON pointer; empty: parameters alone.",
    )
    own: bool = Field(default=False, description="Whether kinds that are alike do not have it.")
    required: bool = False


class JobOption(BaseModel):
    """One option of a command line that asks for a kind."""

    fields: list[str] = Field(description="Fields that it stands for.")
    form: Form
    name: str | None = Field(default=None, description="null: that of the kind.")


class JobKind(BaseModel):
    """A kind of job."""

    help: str
    option: JobOption | None = Field(default=None, description="null: its document is given whole.")
    fields: dict[str, JobField]
    results: list[str] = Field(description="Parts of a job's address where its results are.")


class KindList(BaseModel):
    """All kinds, by name."""

    kinds: dict[str, JobKind]


@router.get("")
def list_kinds() -> KindList:
    """List the kinds of jobs: what each is, the fields of its document, where its results are."""
    return _list(tuple(KINDS))


@cache
def _list(names: tuple[str, ...]) -> KindList:
    described = description()
    return KindList.model_validate({"kinds": {name: described[name] for name in names}})
