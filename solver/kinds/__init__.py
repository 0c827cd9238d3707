"""The kinds of jobs: one file a kind, named by this registry.

A job document is checked whole and filled in before anything is queued (`admit`); a worker makes
the same plan of the stored, filled-in document (`parse`) without checking it again.
"""

from collections.abc import Mapping
from typing import Annotated, Any, Union

from pydantic import Field

from jointplay.records.failure import InvalidInput
from jointplay.records.remarks import without_remarks
from jointplay.solver.calibration.plan import CalibrationStudy
from jointplay.solver.calibration.problem import Calibration
from jointplay.solver.kinds.accuracy_study import AccuracyStudy
from jointplay.solver.kinds.basin_stability import BasinStability
from jointplay.solver.kinds.basins import Basins
from jointplay.solver.kinds.bifurcation import Bifurcation
from jointplay.solver.kinds.calibration import CalibrationKind
from jointplay.solver.kinds.chart import Chart
from jointplay.solver.kinds.continuation import Continuation
from jointplay.solver.kinds.documents import job_of, kind_of
from jointplay.solver.kinds.ensemble import Ensemble
from jointplay.solver.kinds.idle_fields import check_varied
from jointplay.solver.kinds.kind import Kind
from jointplay.solver.kinds.meant_fields import with_meant_fields
from jointplay.solver.kinds.poincare import Poincare
from jointplay.solver.kinds.sensitivity import SensitivityKind
from jointplay.solver.kinds.simulate import Simulate
from jointplay.solver.kinds.sweep import Sweep
from jointplay.solver.runs.admission import Admission
from jointplay.solver.runs.study.plan import Study

__all__ = ["KINDS", "Admission", "Kind", "Study", "admit", "admit_calibration", "any_job", "parse"]

KINDS: dict[str, Kind[Any]] = {
    kind.name: kind
    for kind in (
        Simulate(),
        Bifurcation(),
        Sweep(),
        Chart(),
        Basins(),
        BasinStability(),
        SensitivityKind(),
        Continuation(),
        Poincare(),
        Ensemble(),
        AccuracyStudy(),
        CalibrationKind(),
    )
}


def admit(document: object) -> Admission | Study:
    """Check a job document of any kind and fill in its defaults.

    Parameters
    ----------
    document
        A client's, parsed from JSON; remarks in it count as nothing.

    Returns
    -------
    Admission or Study
        A trajectory for the kind ``simulate``, points for all others.

    Raises
    ------
    InvalidInput
        With every problem that was found, each pointing at its field.
    LimitExceeded
        The job is sound but too large; the sentence gives the estimate.
    """
    document = without_remarks(document)
    kind = kind_of(document, KINDS)
    job = job_of(document, kind)
    try:
        admitted = kind.admit(job)
    except InvalidInput as error:
        told = with_meant_fields(error.problems, document, kind.document)
        raise type(error)(told) from None
    if isinstance(admitted, Study):
        check_varied(job, kind.varied(job, admitted))
    return admitted


def admit_calibration(document: object) -> Calibration:
    """Check a calibration as `admit` does; a job of another kind is refused."""
    if isinstance(document, Mapping) and document.get("kind") != "calibration":
        raise InvalidInput.at("/kind", "'kind' must be 'calibration'.")
    found = admit(document)
    assert isinstance(found, CalibrationStudy)  # noqa: S101  (of that kind)
    return found.calibration


def parse(filled: dict[str, Any]) -> Admission | Study:
    """Return what `admit` returned for a job from the document that it filled in.

    Raises
    ------
    InvalidInput
        The document is not one that this solver's `admit` fills in.
    """
    kind = kind_of(filled, KINDS)
    return kind.plan(job_of(filled, kind), filled)


def any_job() -> Any:
    """Return the type of a job of any kind, for schemas."""
    models = tuple(kind.document for kind in KINDS.values())
    return Annotated[Union[models], Field(discriminator="kind")]  # noqa: UP007
