"""Whether there are workers for every solver, and class of processors, that jobs wait for."""

from collections.abc import Iterator

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.reconciliation.finding import Finding
from jointplay.storage.settings import Settings


def unserved(settings: Settings, catalogue: Catalogue) -> Iterator[Finding]:
    """Look for jobs that wait while all workers there are have another solver."""
    if not catalogue.workers():
        return  # the service is stopped
    found = catalogue.unserved()
    for solver in sorted(set(found.values()), key=str):
        of_class = f" on a processor {solver.processor}" if solver.processor else ""
        yield Finding(
            "workers",
            tuple(f"job {job}" for job, needed in found.items() if needed == solver),
            f"needs solver {solver.version}{of_class}, which no worker has",
            advice="start a worker with it, or cancel such jobs and submit them again",
        )
