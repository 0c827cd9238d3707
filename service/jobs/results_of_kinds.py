"""Results that a job of each kind has, as parts of its address."""

from jointplay.service.problems import RequestRefused, kinds
from jointplay.solver.kinds import KINDS
from jointplay.storage.catalogue import Job


def results_of(job: Job) -> tuple[str, ...]:
    """Return the last parts of the addresses of a job's results."""
    return KINDS[job.kind].results


def is_study(job: Job) -> bool:
    """Tell whether a job has points, and not one history."""
    return "history" not in results_of(job)


def insist(job: Job, result: str) -> None:
    """Refuse with 404 what a job of this kind does not have."""
    if result in results_of(job):
        return
    addresses = ", ".join(f"/v1/jobs/{job.id}/{name}" for name in results_of(job))
    raise RequestRefused(
        kinds.WRONG_KIND,
        f"Job {job.id} is of kind {job.kind} and has no {result}; it has {addresses}.",
    )
