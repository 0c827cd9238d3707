"""What studies share whose points are looked at section by section."""

from typing import Annotated, Any, Literal, get_args

from pydantic import Field

from jointplay.solver.jobs.job import ChannelChoice, Job
from jointplay.solver.jobs.section import CrankSection, Section
from jointplay.solver.scene.unions import form, told_by

Indicator = Literal["lyapunov", "zero_one", "recurrence", "rotation", "spectrum"]
INDICATORS: tuple[Indicator, ...] = get_args(Indicator)

PERIODS = {"unit": "periods"}


def _form_of_settle(value: Any) -> str | None:
    if isinstance(value, str):
        return "auto" if value == "auto" else None
    return "periods"


Settle = Annotated[
    Annotated[int, Field(ge=0, le=10**12), form("periods")]
    | Annotated[Literal["auto"], form("auto")],
    told_by(_form_of_settle, "'settle' must be a whole number of periods, or 'auto'"),
    Field(
        description=(
            "periods before the first recorded section; auto: until the statistics of the sections"
            " have settled"
        ),
        json_schema_extra=PERIODS,
    ),
]


def _form_of_indicators(value: Any) -> str | None:
    if isinstance(value, str):
        return "all" if value == "all" else None
    return "list"


IndicatorChoice = Annotated[
    Annotated[
        list[Literal["lyapunov", "zero_one", "recurrence", "rotation", "spectrum", "all"]],
        Field(max_length=16),
        form("list"),
    ]
    | Annotated[Literal["all"], form("all")],
    told_by(_form_of_indicators, "'indicators' must be a list of indicators, or 'all'"),
    Field(description="what tells regular from chaotic motion, each with its uncertainty"),
]


class SectionStudyJob(Job):
    """A study of Poincare sections: after settling, `record` sections of each point are kept."""

    settle: Settle = 100
    record: Annotated[
        int,
        Field(ge=1, le=10**12, description="sections kept per point", json_schema_extra=PERIODS),
    ] = 50
    section: Section = CrankSection()
    observables: Annotated[
        ChannelChoice | None,
        Field(
            description=(
                "channels kept at sections, names or globs; default: the generalised coordinates"
                " and the eccentricities, with their rates"
            )
        ),
    ] = None
    indicators: IndicatorChoice = []
