"""Studies whose points devices compute."""

from jointplay.records.failure import InvalidInput
from jointplay.solver.integrators import METHODS
from jointplay.solver.integrators.method import Rosenbrock
from jointplay.solver.runs.admission import Admission
from jointplay.solver.runs.study.plan import Study

INSTEAD = "Leave 'device' out: the processor computes it."


def required_study(job: Study | Admission) -> Study:
    """Return a job that devices compute.

    Raises
    ------
    InvalidInput
        They do not, for the sake of the field that it names.
    """
    if type(job) is not Study:  # other kinds than of points side by side have types of their own
        kind = job.job["kind"]
        raise InvalidInput.at("/kind", f"A device computes no job of the kind '{kind}'. {INSTEAD}")
    if job.channels:
        raise InvalidInput.at("/channels", f"A device seeks no extremes of channels. {INSTEAD}")
    if isinstance(METHODS[job.method], Rosenbrock):
        raise InvalidInput.at("/method", f"A device computes explicit methods alone. {INSTEAD}")
    if "channel" in (job.job.get("section") or {}):
        detail = f"A device takes sections at drivers' angles and at onsets. {INSTEAD}"
        raise InvalidInput.at("/section", detail)
    return job
