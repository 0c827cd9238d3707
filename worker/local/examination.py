"""Whether the files of a local run's folder are what the run left."""

import json
import shutil
from collections.abc import Iterator, Mapping
from functools import partial
from math import isclose
from pathlib import Path
from typing import Any

from jointplay.storage import durable
from jointplay.storage.errors import CorruptStore, NotAStore
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.object_stores.folder import Folder
from jointplay.storage.reconciliation.finding import Finding
from jointplay.storage.reconciliation.results import verified
from jointplay.worker.local.ending import ended
from jointplay.worker.local.folder import JOB_FILE, OUTCOME_FILE, RUNNING, STORE
from jointplay.worker.local.outcome import outcome_of


def examined(folder: Path) -> Iterator[Finding]:
    """Yield everything that is not as it should be; nothing is mended by it."""
    again = f"jointplay run {folder / JOB_FILE} -o AGAIN"
    if not (folder / STORE).exists():
        if not (folder / OUTCOME_FILE).exists():
            found = "is not there: the run was cut short, or goes on"
            yield _finding(folder, STORE, found, advice=f"jointplay run --resume {folder}")
        return
    try:
        attributes = verified(StoredObject(Folder(str(folder)), STORE))
    except (NotAStore, CorruptStore) as error:
        yield _finding(folder, STORE, str(error), advice=again)
        return
    job = attributes["job"]
    if _document(folder / JOB_FILE) != job:
        content = (json.dumps(job, indent=2) + "\n").encode()
        mend = partial(durable.write, folder / JOB_FILE, [content])
        found = f"is not the job of {STORE}"
        yield _finding(folder, JOB_FILE, found, "written anew", mend=mend)
    if wrong := _wrong_outcome(folder, attributes):
        mend = partial((folder / OUTCOME_FILE).unlink, missing_ok=True)
        yield _finding(folder, OUTCOME_FILE, wrong, "removed", mend=mend)
    if (folder / RUNNING).exists() and ended(folder):
        mend = partial(shutil.rmtree, folder / RUNNING, ignore_errors=True)
        yield _finding(folder, RUNNING, "is left over", "removed", mend=mend)
    for path in sorted(folder.glob(f"*{durable.PARTIAL}")):
        mend = partial(path.unlink, missing_ok=True)
        yield _finding(folder, path.name, "is left over", "removed", mend=mend)


def _finding(
    folder: Path, name: str, found: str, mended: str | None = None, **more: Any
) -> Finding:
    return Finding(str(folder), (name,), found, mended, **more)


def _wrong_outcome(folder: Path, attributes: Mapping[str, Any]) -> str | None:
    """Return what is wrong with how the run is said to have ended; none of one that is not said."""
    try:
        outcome = outcome_of(folder)
    except (FileNotFoundError, NotADirectoryError):
        return None
    except ValueError:
        if _document(folder / OUTCOME_FILE) is None:
            return "is no JSON document"
        return "is not what a run writes"
    job, reached = attributes["job"], outcome["progress"]
    end = job["duration"] if job["kind"] == "simulate" else 0.0
    whole = reached["fraction"] == 1.0 and isclose(reached["time"], end, rel_tol=1e-9)
    ended = outcome["state"] == "succeeded"
    if ended != attributes["complete"] or (ended and not whole):
        return f"is not the end of {STORE}"
    return None


def _document(path: Path) -> Any:
    """Return what a file of JSON holds; None where it holds none."""
    try:
        return json.loads(path.read_bytes())
    except (FileNotFoundError, ValueError):
        return None
