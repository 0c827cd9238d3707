"""Checks of what a stopped service has left: sentences on what is wrong, none if all is well."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Final

from jointplay.chaos.history import History, Submission
from jointplay.chaos.installation import Installation
from jointplay.chaos.undisturbed import files_of
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import CatalogueError
from jointplay.storage.catalogue.records import Job, JobState
from jointplay.storage.durable import PARTIAL
from jointplay.storage.errors import ResultsError
from jointplay.storage.packed import Packed
from jointplay.storage.places import StoredObject
from jointplay.storage.results.manifest import verify

_DATA: Final = {
    "broker",
    "catalogue.sqlite",
    "catalogue.sqlite-shm",
    "catalogue.sqlite-wal",
    "logs",
    "results",
    "running",
    "serve.lock",
}
"""Everything that a data folder may hold."""
_TERMINAL: Final = {state.value for state in JobState if state.terminal}


def wrongs(
    installation: Installation, history: History, expected: Mapping[int, dict[str, bytes]]
) -> list[str]:
    """Return a sentence for everything that a campaign must not leave behind.

    Parameters
    ----------
    installation
        Stopped.
    history
        Everything that was asked and answered.
    expected
        Files of the undisturbed stores, by the number of the job in the mix.
    """
    found = list(history.violations)
    found += [
        f"process {one.pid} ({one.role}) outlived the service" for one in installation.running()
    ]
    catalogue = Catalogue(installation.settings.catalogue_url)
    try:
        jobs: dict[str, Job] = {}
        for submission in history.submissions:
            if submission.job is None:
                found.append(f"the submission {submission.key} was never accepted")
                continue
            try:
                jobs[submission.job] = catalogue.get(submission.job)
            except CatalogueError as error:
                found.append(f"job {submission.job} was accepted and is lost: {error}")
                continue
            found += _how_it_ended(catalogue, submission, jobs[submission.job])
            if jobs[submission.job].state is JobState.succeeded:
                files = expected[submission.template]
                found += _bytes(installation, jobs[submission.job], files)
        found += _strangers(catalogue, jobs)
    finally:
        catalogue.close()
    return found + list(_leftovers(installation, jobs))


def _how_it_ended(catalogue: Catalogue, submission: Submission, job: Job) -> Iterator[str]:
    """Look at a job's events and attempts: one end, and every attempt before it in order."""
    said, allowed = job.state.value, {"succeeded"} | ({"cancelled"} if submission.cancel else set())
    if said not in allowed:
        why = "" if job.error is None else f": {job.error.detail}"
        yield f"job {job.id} ({job.kind}) ended as {said}{why}"
    if submission.state != said:
        yield f"job {job.id} is {said}, and {submission.state} was answered"
    events = catalogue.events(job.id)
    ends = [event.type for event in events if event.type in _TERMINAL]
    if ends != [said] or events[-1].type != said:
        yield f"job {job.id} ended as {ends or 'nothing'}, its last event is {events[-1].type}"
    if [event.seq for event in events] != list(range(1, len(events) + 1)):
        yield f"job {job.id} has events that are missing or doubled"
    for block in catalogue.blocks(job.id):
        tries = [one for one in catalogue.attempts(job.id) if one.block == block.id]
        if [one.number for one in tries] != list(range(1, len(tries) + 1)):
            yield f"block {block.id} has attempts that are missing or doubled"
        if any(one.outcome is None for one in tries):
            yield f"block {block.id} has an attempt without an end"
        finished = [one.number for one in tries if one.outcome in ("done", "cancelled", "failed")]
        if len(finished) > 1 or (finished and finished[-1] != len(tries)):
            yield f"block {block.id} was finished by attempts {finished} of {len(tries)}"
        if said == "succeeded" and [one.outcome for one in tries].count("done") != 1:
            yield f"block {block.id} of a job that succeeded was not done once"


def _sealed(installation: Installation, job: Job) -> StoredObject:
    if job.kind == "simulate":
        return installation.settings.sealed_run(job.id, job.attempt)
    return installation.settings.sealed_study(job.id)


def _bytes(installation: Installation, job: Job, expected: Mapping[str, bytes]) -> Iterator[str]:
    sealed = _sealed(installation, job)
    try:
        verify(Packed(sealed))
        stored = files_of(sealed)
    except (ResultsError, OSError) as error:
        yield f"the results of job {job.id} cannot be read: {error}"
        return
    for key in sorted(stored.keys() ^ expected.keys()):
        yield f"{key} of job {job.id} is only in one of the disturbed and undisturbed results"
    for key in sorted(stored.keys() & expected.keys()):
        if stored[key] != expected[key]:
            yield f"{key} of job {job.id} ({job.kind}) has other bytes than undisturbed"


def _strangers(catalogue: Catalogue, known: Mapping[str, Job]) -> Iterator[str]:
    after: str | None = None
    while True:
        page = catalogue.jobs(limit=1000, after=after)
        for job in page.jobs:
            if job.id not in known:
                yield f"job {job.id} is there, and no answer had named it"
        if page.next is None:
            return
        after = page.next


def _leftovers(installation: Installation, jobs: Mapping[str, Job]) -> Iterator[str]:
    """Look for files that nobody will need: of succeeded jobs only the results may be there."""
    data = installation.data
    for path in data.iterdir():
        if path.name not in _DATA:
            yield f"{path.name} is left in the data folder"
    due = {_sealed(installation, job).key for job in jobs.values()}
    cancelled = {job.id for job in jobs.values() if job.state is JobState.cancelled}
    for path in _files_below(data / "results"):
        if path.name.endswith(PARTIAL) or str(path.relative_to(data / "results")) not in due:
            yield f"{path.relative_to(data)} is left over"
    for path in _files_below(data / "running"):
        job = path.relative_to(data / "running").parts[1]
        if job not in cancelled or path.name.endswith(PARTIAL):  # these show what was computed
            yield f"{path.relative_to(data)} is left over"


def _files_below(folder: Path) -> list[Path]:
    return sorted(path for path in folder.rglob("*") if not path.is_dir())
