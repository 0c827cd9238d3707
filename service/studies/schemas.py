"""Studies as the API shows them: columns over their points. What is not known is null."""

from typing import Literal

from pydantic import BaseModel, Field

from jointplay.service.fields import in_unit
from jointplay.service.results.schemas import Described, Partial, Series, Values

Status = Literal["waiting", "running", "done", "failed"]


class PointFailure(BaseModel):
    """Failure of one point; what it recorded before is kept."""

    point: int
    code: str = Field(description="The reason for programs, for example step-size-underflow.")
    detail: str = Field(description="The reason, and what to try.")
    time: float = in_unit("s", "Simulated time reached.")


class StudyPoints(Partial):
    """A range of a study's points, the first being `start`; every list has one entry a point."""

    points: int = Field(description="Points of the whole study.")
    start: int = Field(description="Index of the first point in this answer.")
    next_start: int | None = Field(
        description="Give it as start for the points that did not fit; null: there are none."
    )
    values: dict[str, Series] = Field(description="By parameter, its value at each point.")
    status: list[Status] = Field(
        description="What each point is doing; running in a job that has ended: begun, unfinished."
    )
    failures: list[PointFailure] = Field(description="Of the points that failed.")
    statistics: dict[str, Series] = Field(
        description="By name: steps, onsets, energy_residual and others; of a sweep, what the job "
        "chose of the shown channels and of joints, such as A.normal_force.mean, A.contact_share."
    )


class JudgedPoints(StudyPoints):
    """Points with what tells regular from chaotic motion."""

    counts: list[int] = Field(
        description="Sections that each point has recorded, also where a window shows fewer."
    )
    indicators: dict[str, Series] = Field(
        description="By name, the uncertainties as `…_error`: lyapunov, zero_one, period, rotation "
        "and others, as far as they were asked for."
    )
    verdicts: list[str | None] | None = Field(
        description="periodic, quasi-periodic, chaotic, equilibrium or undecided; null: not asked "
        "for."
    )
    reasons: list[str | None] | None = Field(
        description="Grounds of each verdict, and why an indicator says nothing; null: not asked "
        "for."
    )


class Rows(Described):
    """A quantity at the sections of every point: as many values as it recorded."""

    values: list[Values]


class Bifurcation(JudgedPoints):
    """An observable at the sections of every value of the parameter."""

    parameter: str
    directions: list[Literal["forward", "backward"]] | None = Field(
        description="Of the continuation in both directions, which has two points a value."
    )
    observable: str
    sections: Rows


class Sections(JudgedPoints):
    """Times and channels at the sections of every point."""

    time: Rows
    channels: dict[str, Rows]


class PeakColumns(Described):
    """Signed extremes of one channel, found between the samples too."""

    minimum: Values
    minimum_time: Values = in_unit("s")
    maximum: Values
    maximum_time: Values = in_unit("s")
    range: Values = Field(description="Maximum less minimum.")


class Sweep(StudyPoints):
    """Extremes and statistics of channels over the parameters."""

    peaks: dict[str, PeakColumns]


class Axis(Described):
    """One axis of a map."""

    name: Literal["y", "x"]
    parameter: str
    values: Values


class Points(JudgedPoints):
    """All that is known of points; other addresses show parts of it."""

    shape: list[int] = Field(
        description="Points along each axis: of one, all; of a map, along y and x."
    )
    axes: list[Axis] = Field(description="Of a map, y and x; empty: the points are on one axis.")
    time: Rows | None = Field(description="Of the sections; null: no observables were asked for.")
    sections: dict[str, Rows] = Field(description="By observable.")
    peaks: dict[str, PeakColumns] = Field(description="By channel whose extremes were kept.")
    runs: list[dict[str, str | float | bool | None]] = Field(
        description="Of an accuracy-study, method, tolerance and step of every point of the study."
    )


class SpecialOrbit(BaseModel):
    """An orbit of a branch at which something changes."""

    row: int = Field(description="Index of the orbit in the columns.")
    label: str = Field(
        description="EP end, LP fold, PD period doubling, NS Neimark-Sacker, BP branch point, GR"
        " grazing: an impact begins or ends, MX the branch was lost; on curves of special orbits"
        " CP cusp, R1 to R4 resonances 1:1 to 1:4, GPD generalised doubling, and what happens"
        " there besides."
    )
    value: float = in_unit("the parameter's unit")
    bound: float = in_unit(
        "the parameter's unit", "Error of locating it; that of the runs' tolerance comes besides."
    )
    second: float | None = in_unit("the second parameter's unit", "null: none varies.")
    second_bound: float | None = in_unit("the second parameter's unit", "Error of that.")
    note: str = Field(description="What happens there; of an end why, and what to try.")


class Branch(BaseModel):
    """Periodic orbits along a branch, one each row, in the order of being found."""

    index: int
    of: str = Field(
        description="Label of the special orbits that a curve over both parameters is of; empty:"
        " it is a branch."
    )
    status: Status
    failure: PointFailure | None = Field(description="Why there is no branch; null: there is.")
    columns: dict[str, Series] = Field(
        description="By name: value of the parameter, length along the branch, label, impacts in a"
        " period, unstable multipliers, residual, multipliers with their error, and the section."
    )
    special: list[SpecialOrbit]


class Branches(Partial):
    """Branches of a continuation: the first one, then those behind its period doublings.

    Then those through its branch points, those of other orbits of the motion, and curves of special
    orbits of the first one over a second parameter.
    """

    parameter: str
    unit: str
    second: str | None = Field(description="The second parameter; null: none varies.")
    second_unit: str | None
    labels: list[str] = Field(description="By the numbers in the column label; 0: none.")
    branches: list[Branch]


class AccuracyPoint(BaseModel):
    """One run of an accuracy-study."""

    method: str
    tolerance: float | None = in_unit("1", "null: the step is fixed.")
    step: float | None = in_unit("s", "null: the error is controlled.")
    admitted: bool = Field(description="Whether jobs may ask for it.")
    error: float | None = in_unit(
        "1",
        "Root mean square over the window, of coordinates and speeds, relative to the "
        "scales that tolerances are relative to; null: the run did not come to its end.",
    )
    relative_energy_residual: float | None = in_unit(
        "1",
        "What the energy balance lacks at the end, divided by what contacts and friction took; "
        "null: they took nothing.",
    )
    steps: int = in_unit("1", "Accepted steps.")
    evaluations: int = in_unit("1", "Of the equations of motion, in attempted steps.")
    seconds: float = in_unit("s", "Computing time of one core; differs when it is measured again.")
    failure: str | None = Field(description="Why the run did not come to its end.")


class Accuracy(Partial):
    """Cost and error of every method and tolerance, against a reference run."""

    duration: float = in_unit("s", "Simulated time of every run.")
    window: float | None = in_unit(
        "s", "Time from the start in which the reference is known; null: not yet, 0: nowhere."
    )
    uncertainty: float | None = in_unit(
        "1", "How far two references are apart there; smaller errors mean nothing. Null: unknown."
    )
    points: list[AccuracyPoint] = Field(description="The runs that were computed so far.")
    advice: str | None = Field(description="What to choose; null: the study is not complete.")
