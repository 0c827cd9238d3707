"""The kinds whose points are looked at section by section: document, admission and plan."""

from typing import Annotated, Any, Literal, TypeVar, get_args

from pydantic import Field

from jointplay.records.arrays import Floats
from jointplay.solver.kinds import documents
from jointplay.solver.kinds.checked_points import check_points
from jointplay.solver.kinds.job import Energies, Job, Observables
from jointplay.solver.kinds.limits import EVENT_PATIENCE, LONGEST_SETTLING, check_size
from jointplay.solver.kinds.methods import check_study
from jointplay.solver.kinds.observables import chosen, coordinate_channels
from jointplay.solver.kinds.periods import Periods, crank_offsets, periods
from jointplay.solver.kinds.section import ChannelSection, CrankSection, Section
from jointplay.solver.kinds.section_checks import check_section
from jointplay.solver.kinds.studies import Kept, PlacedPoints, Spans, StudyKind, make_study
from jointplay.solver.quantities.units import quantity
from jointplay.solver.runs.starts import Perturbation
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.scene.unions import discriminated_by, form

Indicator = Literal["lyapunov", "zero_one", "recurrence", "rotation", "spectrum"]
INDICATORS: tuple[Indicator, ...] = get_args(Indicator)
COMPARING = frozenset({"lyapunov", "zero_one", "recurrence", "rotation"})
COMPARED = 1e-9
"""Default tolerance with indicators that tell small differences of sections, or of neighbours, from
the noise of steps. Friction that holds a joint with play lets 1e-6 miss a thousandth of the
clearance: of 40 speeds of a crank-rocker it decides 1, 1e-8 14, 1e-9 22, 1e-10 24."""


def _form_of_settle(value: Any) -> str | None:
    if isinstance(value, str):
        return "auto" if value == "auto" else None
    return "periods"


Settle = Annotated[
    Annotated[int, Field(ge=0, le=10**12), form("periods")]
    | Annotated[Literal["auto"], form("auto")],
    discriminated_by(_form_of_settle, "'settle' must be a whole number of periods, or 'auto'"),
    quantity(
        "periods",
        description=(
            "periods before the first recorded section; auto: until the statistics of the sections"
            " have settled"
        ),
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
    discriminated_by(_form_of_indicators, "'indicators' must be a list of indicators, or 'all'"),
    Field(description="what tells regular from chaotic motion, each with its uncertainty"),
]


class SectionsJob(Job):
    """A study that takes `record` sections of each point after settling."""

    settle: Settle = 100
    record: Annotated[
        int, quantity("periods", ge=1, le=10**12, description="sections taken per point")
    ] = 50
    section: Section = CrankSection()
    indicators: IndicatorChoice = []

    @property
    def usual_tolerance(self) -> float:
        """Tolerance where none is given: such as the indicators need; see `COMPARING`."""
        compared = set(indicators_of(self)) & COMPARING
        return COMPARED if compared else super().usual_tolerance

    @property
    def named_channels(self) -> list[str]:
        """See `MechanismJob.named_channels`."""
        return [self.section.channel] if isinstance(self.section, ChannelSection) else []


class SectionStudyJob(SectionsJob):
    """A study whose sections are kept."""

    observables: Observables = None
    energies: Energies = True

    @property
    def named_channels(self) -> list[str]:
        """See `MechanismJob.named_channels`."""
        return [*(self.observables or []), *super().named_channels]


J = TypeVar("J", bound=SectionStudyJob)


class SectionStudy(StudyKind[J]):
    """A kind of sections, as `bifurcation`, `poincare` and `ensemble`; a member has its points."""

    def continuation(self, job: J) -> tuple[str, int]:
        """Return in which direction a point starts from its neighbour, and how many chains do."""
        return "none", 1

    def perturbation(self, job: J) -> Perturbation | None:
        """Return how points start apart that differ in nothing else."""
        return None

    def admit(self, job: J) -> Study:
        """Check and fill in; see `Kind.admit`."""
        indicators = indicators_of(job)
        check_study(job, tangents="lyapunov" in indicators)
        checked = check_points(job, self.points(job))
        default = coordinate_channels(checked)
        observables = chosen(checked, job.observables, default, "/observables")
        units = periods(checked.scenes)
        check_section(job.section, checked, units)
        filled = documents.filled(
            job,
            checked.document,
            checked.echo,
            observables=[channel.name for channel in observables],
            indicators=list(indicators),
        )
        study = self.study(job, filled, checked, units)
        settle, recording = most_periods(job)
        pointer = "/settle" if isinstance(job.settle, int) and settle > recording else "/record"
        check_size(study, settle + recording, pointer)
        return study

    def study(self, job: J, filled: dict[str, Any], placed: PlacedPoints, units: Periods) -> Study:
        """Return the study; see `StudyKind.study`."""
        kept = Kept(
            observables=placed.channels(filled["observables"]),
            record=job.record,
            indicators=tuple(filled["indicators"]),
        )
        return make_study(
            filled,
            placed,
            section_spans(job, units),
            kept,
            self.continuation(job),
            self.perturbation(job),
        )


def section_spans(job: SectionsJob, units: Periods, offset: Floats | None = None) -> Spans:
    """Return how long points run until they have settled and their sections are taken.

    `offset` : (points,) s, of sections behind whole periods; by default that of the crank angle.
    """
    settle, recording = most_periods(job)
    if offset is None:
        angle = job.section.crank_angle if isinstance(job.section, CrankSection) else 0.0
        offset = crank_offsets(units, angle)
    unit = units.seconds
    return Spans(unit, settle * unit, (settle + recording) * unit + offset, offset)


def most_periods(job: SectionsJob) -> tuple[int, int]:
    """Return the most periods that settling takes, and recording after it."""
    settle = LONGEST_SETTLING if job.settle == "auto" else job.settle
    turning = isinstance(job.section, CrankSection)
    return settle, job.record if turning else EVENT_PATIENCE * job.record


def indicators_of(job: SectionsJob) -> tuple[str, ...]:
    """Return the indicators that a job asks for, in their own order."""
    return tuple(
        name
        for name in INDICATORS
        if job.indicators == "all" or "all" in job.indicators or name in job.indicators
    )
