"""Lists of jobs: their pages, and their filters."""

import re
from datetime import UTC, datetime
from typing import Annotated, Any

from pydantic import AfterValidator, AwareDatetime, BaseModel, BeforeValidator, ConfigDict, Field

from jointplay.records.job import is_job_id
from jointplay.service.problems import RequestRefused
from jointplay.solver.kinds import KINDS
from jointplay.storage.catalogue.records import JobState


def _written(moment: object) -> object:
    if isinstance(moment, str) and not _DATE.match(moment):
        raise ValueError("Give a moment as RFC 3339 has it, such as 2026-01-01T00:00:00Z")
    return moment


_DATE = re.compile(r"\d{4}-\d{2}-\d{2}[Tt ]", re.ASCII)  # and no number of seconds
Moment = Annotated[AwareDatetime, BeforeValidator(_written)]


def _without_zero(name: str) -> str:
    if "\0" in name:  # which PostgreSQL cannot be asked for
        raise ValueError("No name has the character U+0000: leave it out")
    return name


Name = Annotated[
    str,
    Field(max_length=200, json_schema_extra={"pattern": r"^[^\u0000]*$"}),
    AfterValidator(_without_zero),
]


class PageQuery(BaseModel):
    """One page of a list."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    page_size: int = Field(
        default=50,
        ge=1,
        le=1000,
        description="Most entries of one page; of jobs with long documents there are fewer.",
    )
    page_token: str | None = Field(default=None, description="next_page_token of the page before.")

    def checked_token(self) -> str | None:
        """Return the token, or refuse one that this service never gave."""
        if self.page_token is not None and not is_job_id(self.page_token):
            raise RequestRefused.of_parameter(
                "page_token",
                "The page_token is not one that this service gave.",
                remedy="Give the next_page_token of a page, or leave it out.",
            )
        return self.page_token


class JobQuery(PageQuery):
    """Filters, and a page of the list."""

    state: JobState | None = Field(default=None, description="Only jobs in this state.")
    kind: str | None = Field(
        default=None,
        description="Only jobs of this kind.",
        json_schema_extra=lambda schema: schema.update(enum=[*KINDS]),
    )
    label: Name | None = Field(default=None, description="Only jobs with exactly this label.")
    scene: Name | None = Field(
        default=None, description="Only jobs of this preset, or scene's name."
    )
    since: Moment | None = Field(
        default=None, description="Only jobs submitted from this moment on, RFC 3339 with offset."
    )
    before: Moment | None = Field(
        default=None, description="Only jobs submitted before this moment."
    )

    def wanted(self) -> dict[str, Any]:
        """Return the filters as the catalogue takes them, or refuse what matches nothing."""
        if self.kind is not None and self.kind not in KINDS:
            sentence = f"There is no kind {self.kind!r}; there are {', '.join(KINDS)}."
            raise RequestRefused.of_parameter("kind", sentence)
        if self.since is not None and self.before is not None and self.since > self.before:
            sentence = "'before' is earlier than 'since'; swap them."
            raise RequestRefused.of_parameter("before", sentence)
        filters = self.model_dump(exclude={"page_size", "page_token"})
        return filters | {"since": _epoch(self.since), "before": _epoch(self.before)}


def _epoch(moment: datetime | None) -> float | None:
    """Return epoch seconds; also of years that the clock of this machine does not reach."""
    origin = datetime(1970, 1, 1, tzinfo=UTC)
    return None if moment is None else (moment - origin).total_seconds()
