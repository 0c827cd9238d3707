"""Results that a job must have, known from its document alone."""

from typing import Final, NamedTuple

from jointplay.records.bounded_dict import BoundedDict
from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import Admission, parse
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.catalogue.records import Job
from jointplay.storage.results.layout import ResultLayout
from jointplay.storage.studies.layout import StudyLayout
from jointplay.worker.layouts import layout_of_run, layout_of_study

_KEPT: Final = 16
"""Jobs whose layouts are remembered: files of one come one after the other."""
_FEW: Final = 2**26
"""Bytes that any attempt may have here: documents, restart points, impacts."""
_OF_A_PERIOD: Final = 2**20
"""Bytes of the impacts of a period at most."""
_ANY: Final = 2**35
"""Bytes of an attempt at a job that this program cannot read."""


class Expected(NamedTuple):
    """Results of one job."""

    layout: ResultLayout | StudyLayout | None
    """None of a document that only another version of the program can read."""
    same: bool
    """Whether the job's solver is the one that gave this layout."""
    most: int
    """Bytes that one attempt may have here: it sends its rows, and then all of them sealed."""


_known: BoundedDict[tuple[str, str], Expected] = BoundedDict(_KEPT)


def expected_of(job: Job) -> Expected:
    """Return what the results of a job are; the last jobs are remembered."""
    name = job.id, job.solver_version
    found = _known.get(name)
    if found is None:
        found = _known[name] = _expected(job)
    return found


def _expected(job: Job) -> Expected:
    same = job.solver_version == SOLVER_VERSION
    try:
        admitted = parse(job.spec)
    except InvalidInput:
        return Expected(None, same, _ANY)
    if not isinstance(admitted, Admission):
        layout = layout_of_study(admitted)
        return Expected(layout, same, _FEW + 2 * admitted.stored_bytes)
    periods = float(job.spec["duration"]) / admitted.period if admitted.period else 1.0
    rows = admitted.stored_bytes + admitted.steps_limit + int(periods * _OF_A_PERIOD)
    return Expected(layout_of_run(admitted), same, _FEW + 2 * rows)
