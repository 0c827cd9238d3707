"""Whether results are those of a job: what they say of themselves against the catalogue."""

from collections.abc import Mapping
from typing import Any

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import BlockState, Job, JobState
from jointplay.storage.errors import CorruptStore
from jointplay.storage.settings import Settings
from jointplay.storage.studies.reader import StudyReader


def require_results_of(job: Job, attributes: Mapping[str, Any], name: str) -> None:
    """Compare the attributes of a store's root with a job.

    A store that was exchanged with another job's is whole, and differs in this alone. Fields that
    a later version added to the document do not count: it may have computed a job that waited.

    Parameters
    ----------
    job
        As the catalogue knows it.
    attributes
        Of the root of the store, sealed or growing.
    name
        Of the store, for the sentence.

    Raises
    ------
    CorruptStore
        They are another job's results.
    """
    stored = attributes.get("job", {})
    if any(name not in stored or stored[name] != value for name, value in job.spec.items()):
        raise CorruptStore(f"{name} holds the results of another job")
    if not job.state.terminal:
        return
    if attributes["complete"] and job.state is not JobState.succeeded:
        raise CorruptStore(f"{name} holds a whole run, and the job is {job.state}")
    steps = (attributes.get("summary") or {}).get("steps")
    if None not in (steps, job.steps) and steps != job.steps:
        raise CorruptStore(f"{name} holds a run of {steps} steps, and the job took {job.steps}")


def growing_study(settings: Settings, catalogue: Catalogue, job: str) -> StudyReader:
    """Return the reader of a study that is not sealed.

    Raises
    ------
    NotAStore
        There is none yet.
    CorruptStore
        Files are not what was stored, or hold less than the catalogue knows of.
    """
    begun = {
        block.index: block.count if block.state is BlockState.done else block.watermark
        for block in catalogue.blocks(job)
        if block.count and (block.state is BlockState.done or block.checkpoint or block.watermark)
    }
    reader = StudyReader(settings.running_study(job))
    reader.require(begun)
    return reader
