"""Files that nobody will need, and results whose job is not in the catalogue."""

import re
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from typing import Any, Final

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import JobNotFound
from jointplay.storage.catalogue.records import Job, NewJob
from jointplay.storage.durable import PARTIAL
from jointplay.storage.errors import CorruptStore, NotAStore
from jointplay.storage.installation import LINK_SIGNER, MARK
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.reconciliation.extent import Extent
from jointplay.storage.reconciliation.finding import Finding
from jointplay.storage.reconciliation.results import damage_of, sealed_results, verified
from jointplay.storage.settings import OF_A_JOB, RUNNING, Settings

_DATA: Final = {
    "broker",
    "catalogue.sqlite",
    "catalogue.sqlite-shm",
    "catalogue.sqlite-wal",
    MARK,
    "logs",
    "results",
    RUNNING,
    "serve.lock",
}
"""Everything that a data folder may hold."""
_OF_THE_SERVICE: Final = {MARK, LINK_SIGNER}
"""Objects that belong to no job."""
_SEALED: Final = re.compile(
    r"../(?P<job>[0-9A-Z]{26})-(a(?P<attempt>\d+)|study)\.zarr\.zip(\.[0-9a-f]+\.partial)?"
)
_LEFT: Final = "is left over"
_TOLD: Final = 100
"""Objects between two words on how far it is."""
_READ: Final = "jointplay show FILE reads it; remove it, or keep it elsewhere"


def leftovers(settings: Settings, catalogue: Catalogue, extent: Extent) -> Iterator[Finding]:
    """Look for files of jobs that have ended, longer ago than workers take to tidy up."""
    return left_after(settings, catalogue, settings.lease, extent)


def left_after(
    settings: Settings, catalogue: Catalogue, grace: float, extent: Extent | None = None
) -> Iterator[Finding]:
    """Look for files of jobs that ended more than some seconds ago, and of no job.

    Files are listed before their job is looked up: what a worker is about to write is not here.
    """
    yield from _of_the_object_store(settings, catalogue, grace, extent or Extent())
    yield from of_running_jobs(settings, catalogue, grace)
    for path in sorted(settings.data.glob("*")):
        if path.name not in _DATA:
            yield Finding(
                "data", (path.name,), "is left in the data folder", advice=f"rm -r '{path}'"
            )


def _of_the_object_store(
    settings: Settings, catalogue: Catalogue, grace: float, extent: Extent
) -> Iterator[Finding]:
    store = settings.object_store
    keys = sorted([*store.list(""), *store.cut_off("")])
    listed = set(keys)
    for done, key in enumerate(keys):
        if done % _TOLD == 0:
            extent.report(done / len(keys), f"looking at object {done} of {len(keys)}")
        if settings.sends and key.startswith(f"{RUNNING}/") and key.count("/") >= OF_A_JOB:
            continue
        if key in _OF_THE_SERVICE:
            continue
        named = _SEALED.fullmatch(key)
        if named is None:
            advice = "nothing of this name belongs there; move it away"
            yield Finding("results", (key,), _LEFT, advice=advice)
            continue
        job = _job_of(catalogue, named["job"])
        if job is None and not key.endswith(PARTIAL):
            yield _without_job(settings, catalogue, StoredObject(store, key), named)
        elif job is not None and _is_due(settings, job, key, listed):
            continue
        elif job is None or (_settled(job, catalogue, grace) and _not_due(settings, job, key)):
            remove = partial(store.remove, key)
            yield _left("results", key, remove, needed=job is not None and _needed(settings, job))


def of_running_jobs(settings: Settings, catalogue: Catalogue, grace: float) -> Iterator[Finding]:
    """Look for what jobs needed while they ran that ended more than some seconds ago."""
    for job_id in settings.running_jobs():
        job = _job_of(catalogue, job_id)
        name = f"{RUNNING}/{job_id[-2:]}/{job_id}"
        if job is None:
            found = "holds what a job computed that is not in the catalogue"
            advice = "nothing needs it; remove all objects whose keys begin so"
            if not settings.sends:
                advice = f"rm -r '{settings.running_folder(job_id)}'"
            yield Finding("running", (name,), found, advice=advice)
        elif not _settled(job, catalogue, grace):
            continue
        elif not _needed(settings, job):
            yield _left("running", name, partial(_clear, settings, job))
        else:  # it ended without sealed results: these show what was computed
            for path in sorted(settings.running_folder(job_id).rglob(f"*{PARTIAL}")):
                name = str(path.relative_to(settings.data))
                yield _left("running", name, partial(path.unlink, missing_ok=True))


def _job_of(catalogue: Catalogue, job_id: str) -> Job | None:
    try:
        return catalogue.get(job_id)
    except JobNotFound:
        return None


def _settled(job: Job, catalogue: Catalogue, grace: float) -> bool:
    """Whether a job has ended, and workers had the time to remove what it needed."""
    moment = job.removed or job.finished or 0.0
    return job.state.terminal and moment <= catalogue.clock() - grace


def _is_due(settings: Settings, job: Job, key: str, listed: set[str]) -> bool:
    """Whether an object is a job's results, as far as a list of all objects tells that."""
    study, run = settings.sealed_study(job.id).key, settings.sealed_run(job.id, job.attempt).key
    return job.removed is None and (key == study or (key == run and study not in listed))


def _not_due(settings: Settings, job: Job, key: str) -> bool:
    sealed = sealed_results(settings, job)
    return job.removed is not None or sealed is None or sealed.key != key


def _clear(settings: Settings, job: Job) -> None:
    """Remove what lost attempts sealed, then what shows that there is something to remove."""
    store, prefix = settings.object_store, settings.results_prefix(job.id)
    for key in [*store.list(prefix), *store.cut_off(prefix)]:
        if _not_due(settings, job, key):
            store.remove(key)
    settings.running_files(job.id).clear()


def _needed(settings: Settings, job: Job) -> bool:
    """Whether what is left of a job is all that there is: its results are gone, or damaged."""
    if job.removed is not None:
        return False
    return sealed_results(settings, job) is None or damage_of(settings, job) is not None


def _left(where: str, name: str, remove: Callable[[], object], *, needed: bool = False) -> Finding:
    if needed and not name.endswith(PARTIAL):
        return Finding(where, (name,), f"{_LEFT} of a job without whole results", advice=_READ)
    return Finding(where, (name,), _LEFT, "removed", mend=remove)


def _without_job(
    settings: Settings, catalogue: Catalogue, sealed: StoredObject, named: re.Match[str]
) -> Finding:
    """Adopt whole results; whatever else it is, only its owner can say."""
    found = "belongs to no job"
    try:
        attributes = verified(sealed)
        new = _job_in(attributes, _expiry(settings, catalogue))
    except (NotAStore, CorruptStore, KeyError, TypeError, AttributeError) as error:
        found += f", and cannot be adopted: {error}"
        return Finding("results", (str(sealed),), found, advice=_READ)
    if not attributes["complete"]:
        found += ", and is of a run that was cut short"
        return Finding("results", (str(sealed),), found, advice=_READ)
    steps = (attributes.get("summary") or {}).get("steps")
    mend = partial(
        catalogue.adopt, named["job"], new, attempt=int(named["attempt"] or 1), steps=steps
    )
    return Finding("results", (str(sealed),), found, "its job was made again", mend=mend)


def _expiry(settings: Settings, catalogue: Catalogue) -> float | None:
    """Return when an adopted job expires: as if it were submitted now.

    When it was to expire is lost with the catalogue; from its creation on, it may be over.
    """
    return None if settings.keep is None else catalogue.clock() + settings.keep


def _job_in(attributes: Mapping[str, Any], expires: float | None) -> NewJob:
    """Return the job that results describe, as it was submitted."""
    spec, study = attributes["job"], attributes.get("blocks")
    return NewJob(
        kind=spec["kind"],
        label=spec.get("label") or None,
        spec=spec,
        digest=attributes["digest"],
        solver_version=attributes["solver_version"],
        scene=spec["scene"].get("preset") or spec["scene"].get("name"),
        expires=expires,
        blocks=tuple((first, count) for first, count in study) if study else ((0, 1),),
        seal=bool(study),
    )
