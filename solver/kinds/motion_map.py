"""The kinds that tell the motion of very many points: document, admission and plan."""

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, TypeVar

from pydantic import Field

from jointplay.records.arrays import Floats
from jointplay.records.coarse_to_fine import COARSEST
from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import documents
from jointplay.solver.kinds.checked_points import check_points
from jointplay.solver.kinds.job import ChannelChoice
from jointplay.solver.kinds.limits import (
    MOST_OF_A_CHART,
    MOST_PERIODS_OF_A_CHART,
    check_numbers,
    check_size,
)
from jointplay.solver.kinds.map import MapJob, points_of_map
from jointplay.solver.kinds.methods import check_study
from jointplay.solver.kinds.observables import chosen
from jointplay.solver.kinds.periods import Periods, periods
from jointplay.solver.kinds.points import Points
from jointplay.solver.kinds.section_checks import check_section
from jointplay.solver.kinds.section_study import (
    IndicatorChoice,
    SectionsJob,
    indicators_of,
    most_periods,
    section_spans,
)
from jointplay.solver.kinds.statistics import (
    SamplesPerPeriod,
    StatisticChoice,
    check_samples,
    check_statistics,
    statistic_count,
    statistic_outputs,
)
from jointplay.solver.kinds.studies import Kept, PlacedPoints, StudyKind, make_study
from jointplay.solver.quantities.units import quantity
from jointplay.solver.runs.starts import Perturbation
from jointplay.solver.runs.study.cycles import outputs_of
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.study.scenes import PointScenes
from jointplay.solver.statistics import Output


class MotionsJob(SectionsJob):
    """Many points that tell their motion, and what is asked of it beside."""

    indicators: IndicatorChoice = ["lyapunov", "recurrence"]
    channels: Annotated[
        ChannelChoice | None,
        Field(
            description=(
                "channels whose extremes and statistics after settling are kept, names or globs;"
                " default: none"
            )
        ),
    ] = None
    statistics: StatisticChoice = []
    samples_per_period: SamplesPerPeriod = 256

    @property
    def named_channels(self) -> list[str]:
        """See `MechanismJob.named_channels`."""
        return [*(self.channels or []), *super().named_channels]


class MotionMapJob(MotionsJob, MapJob):
    """A map of motions."""

    refine: Annotated[
        int,
        quantity(
            "1",
            ge=0,
            le=COARSEST,
            description=(
                "times that a cell may be split: every 2^refine-th point of both axes is computed,"
                " and what lies between only where corners of a cell differ; other points inherit;"
                " 0: every point is computed"
            ),
        ),
    ] = 0


J = TypeVar("J", bound=MotionsJob)
M = TypeVar("M", bound=MotionMapJob)
NUMBERS, EXTREMES = 8, 4
"""Numbers of every point at most, and of each channel."""


class Motions(StudyKind[J]):
    """A kind that tells the motion of many points; a member has these, and may ask for more."""

    compares_cycles: ClassVar = False
    """Whether points keep what tells their attractors apart."""
    counted: ClassVar = "/by/values"
    """JSON pointer to what says how many points there are."""

    def continuation(self, job: J) -> str:
        """Return in which direction a point starts from its neighbour along x."""
        return "none"

    def perturbation(self, job: J) -> Perturbation | None:
        """Return how several starts of a point lie apart."""
        return None

    def starts(self, job: J) -> int:
        """Return from how many starts each point is computed."""
        return 1

    def refine(self, job: J) -> int:
        """Return how often cells may be split; 0: every point is computed."""
        return 0

    def offset(self, job: J, scenes: PointScenes) -> Floats | None:
        """Return (points,) s: how far sections lie behind whole periods; None: at a crank angle."""
        return None

    def admit(self, job: J) -> Study:
        """Check and fill in; see `Kind.admit`."""
        indicators = indicators_of(job)
        check_study(job, tangents="lyapunov" in indicators)
        _check_length(job)
        checked = check_points(job, self.points(job))
        channels = chosen(checked, job.channels, (), "/channels")
        units = periods(checked.scenes)
        check_section(job.section, checked, units)
        check_statistics(job.statistics, checked.pairs(), len(channels))
        pairs = len(checked.pairs())
        check_numbers(
            checked.points.count,
            NUMBERS
            + EXTREMES * len(channels)
            + statistic_count(job.statistics, len(channels), pairs)
            + (len(outputs_of(checked.declared)) if self.compares_cycles else 0),
            self.counted,
        )
        names = [channel.name for channel in channels]
        filled = documents.filled(
            job, checked.document, checked.echo, channels=names or None, indicators=list(indicators)
        )
        study = self.study(job, filled, checked, units)
        check_samples(job, study)
        settle, recording = most_periods(job)
        pointer = "/settle" if isinstance(job.settle, int) and settle > recording else "/record"
        check_size(study, self.starts(job) * (settle + recording), pointer, MOST_PERIODS_OF_A_CHART)
        return study

    def outputs(self, study: Study) -> Mapping[str, Output]:
        """Return the statistics that the job chose."""
        return statistic_outputs(study)

    def study(self, job: J, filled: dict[str, Any], placed: PlacedPoints, units: Periods) -> Study:
        """Return the study; see `StudyKind.study`."""
        channels, pairs = placed.channels(filled["channels"] or ()), placed.pairs()
        kept = Kept(
            record=job.record,
            channels=channels,
            statistics=statistic_count(job.statistics, len(channels), len(pairs)),
            indicators=tuple(filled["indicators"]),
            brief=True,
            compares_cycles=self.compares_cycles,
            starts=self.starts(job),
            refine=self.refine(job),
        )
        return make_study(
            filled,
            placed,
            section_spans(job, units, self.offset(job, placed.scenes)),
            kept,
            (self.continuation(job), placed.points.shape[0]),  # a chain is a row
            self.perturbation(job),
        )


class MotionMap(Motions[M]):
    """A point for each pair of values, numbered coarse to fine."""

    def points(self, job: M) -> Points:
        """Return the points of the map."""
        return points_of_map(job, MOST_OF_A_CHART)

    def admit(self, job: M) -> Study:
        """Check and fill in; see `Kind.admit`."""
        if job.refine and not job.indicators:
            sentence = "Cells are split where the motion differs; ask for 'recurrence', or another."
            raise InvalidInput.at("/indicators", sentence)
        return super().admit(job)

    def refine(self, job: M) -> int:
        """Return how often cells may be split."""
        return job.refine


def _check_length(job: MotionsJob) -> None:
    """Refuse what needs to be known when settling ends where that is found out on the way."""
    if job.settle != "auto":
        return
    for field in ("channels", "statistics"):
        if getattr(job, field):
            sentence = (
                f"'{field}' are of the time after settling; give a number of periods to settle,"
                " not 'auto'."
            )
            raise InvalidInput.at("/settle", sentence)
