"""Which results a job of each kind has, as parts of its address."""

from jointplay.service.problems import RequestRefused, kinds
from jointplay.storage.catalogue import Job

RESULTS = {
    "simulate": (
        *("history", "peaks", "poincare", "impacts", "statistics", "certificate"),
        *("figures", "zarr"),
    ),
    "bifurcation": ("bifurcation", "poincare", "figures", "zarr"),
    "sweep": ("sweep", "figures", "zarr"),
    "poincare": ("poincare", "figures", "zarr"),
    "ensemble": ("poincare", "figures", "zarr"),
    "accuracy-study": ("accuracy", "figures", "zarr"),
}


def is_study(job: Job) -> bool:
    """Tell whether a job has points, and not one history."""
    return job.kind != "simulate"


def insist(job: Job, result: str) -> None:
    """Refuse with 404 what a job of this kind does not have."""
    if result in RESULTS[job.kind]:
        return
    addresses = ", ".join(f"/v1/jobs/{job.id}/{name}" for name in RESULTS[job.kind])
    raise RequestRefused(
        kinds.WRONG_KIND,
        f"Job {job.id} is of kind {job.kind} and has no {result}; it has {addresses}.",
    )
