"""Stores of tests: where they are sealed, and what is in them."""

from pathlib import Path

from jointplay.storage.catalogue.records import Job
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.object_stores.folder import Folder
from jointplay.storage.packed import Packed, files_at
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.settings import Settings


def packed(folder: Path) -> Path:
    """The file that the store in a folder becomes."""
    return folder.with_name(f"{folder.name}.zip")


def target(folder: Path) -> StoredObject:
    """Where the store in a folder is sealed: beside it."""
    return StoredObject(Folder(str(folder.parent)), packed(folder).name)


def files_of(source: Path | StoredObject) -> dict[str, bytes]:
    """Every file of a sealed store with its bytes."""
    files = files_at(source) if isinstance(source, Path) else Packed(source)
    return {key: files.read(key) for key in files}


def sealed_run(settings: Settings, job: Job) -> ResultReader:
    """The sealed results of a simulation's last attempt."""
    return ResultReader(Packed(settings.sealed_run(job.id, job.attempt)))
