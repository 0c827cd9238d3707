"""Checks of what a stopped service has left: sentences on what is wrong, none if all is well."""

from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import Final

from jointplay.chaos.history import History, Submission
from jointplay.chaos.service import Service
from jointplay.chaos.undisturbed import files_of
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import CatalogueError
from jointplay.storage.catalogue.records import Job, JobState
from jointplay.storage.reconciliation.leftovers import left_after
from jointplay.storage.reconciliation.results import damage_of, sealed_results
from jointplay.storage.reconciliation.rows import inconsistencies
from jointplay.storage.settings import Settings

_READERS: Final = 8
"""Results that are compared at a time: a store elsewhere answers late, not slowly."""
_TERMINAL: Final = {state.value for state in JobState if state.terminal}


def wrongs(
    service: Service, history: History, expected: Mapping[int, dict[str, bytes]]
) -> list[str]:
    """Return a sentence for everything that a campaign must not leave behind.

    Parameters
    ----------
    service
        Stopped.
    history
        Everything that was asked and answered.
    expected
        Files of the undisturbed stores, by the number of the job in the mix.
    """
    found = list(history.violations)
    found += [f"process {one.pid} ({one.role}) outlived the service" for one in service.running()]
    catalogue = Catalogue(service.settings.catalogue_url)
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
        succeeded = [
            (jobs[one.job], expected[one.template])
            for one in history.submissions
            if one.job in jobs and jobs[one.job].state is JobState.succeeded
        ]
        with ThreadPoolExecutor(_READERS) as readers:
            for sentences in readers.map(lambda one: [*_bytes(service, *one)], succeeded):
                found += sentences
        found += _strangers(catalogue, jobs)
        found += _leftovers(service.settings, catalogue)
    finally:
        catalogue.close()
    return found


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


def _bytes(service: Service, job: Job, expected: Mapping[str, bytes]) -> Iterator[str]:
    settings = service.settings
    damage, sealed = damage_of(settings, job), sealed_results(settings, job)
    if damage is not None or sealed is None:
        yield f"the results of job {job.id} cannot be read: {damage}"
        return
    stored = files_of(sealed)
    for key in sorted(stored.keys() ^ expected.keys()):
        yield f"{key} of job {job.id} is only in one of the disturbed and undisturbed results"
    for key in sorted(stored.keys() & expected.keys()):
        if stored[key] != expected[key]:
            yield f"{key} of job {job.id} ({job.kind}) has other bytes than undisturbed"


def _strangers(catalogue: Catalogue, known: Mapping[str, Job]) -> Iterator[str]:
    for job in catalogue.every_job():
        if job.id not in known:
            yield f"job {job.id} is there, and no answer had named it"


def _leftovers(settings: Settings, catalogue: Catalogue) -> Iterator[str]:
    """Look for files that nobody will need, and for inconsistent rows of the catalogue."""
    for finding in (
        *left_after(settings, catalogue, grace=0.0),
        *inconsistencies(settings, catalogue),
    ):
        yield f"{finding.subject} {finding.found}"
