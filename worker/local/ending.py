"""Whether a local run ended by itself, or can go on."""

import json
from pathlib import Path

from jointplay.storage.errors import CorruptStore, NotAStore
from jointplay.storage.packed import files_at
from jointplay.storage.results.live import root_of
from jointplay.worker.local.folder import OUTCOME_FILE, STORE


def ended(folder: Path) -> bool:
    """Return whether a run's folder holds all that the run will ever give: going on adds nothing.

    It succeeded, or failed in a way that is repeated; not so if a signal, a full disk or the loss
    of a process ended it.
    """
    if not (folder / STORE).exists():
        return False
    try:
        state = json.loads((folder / OUTCOME_FILE).read_bytes())["state"]
    except (OSError, ValueError, TypeError, KeyError):
        return _is_complete(folder / STORE)  # killed between the store and the outcome
    return bool(state != "cancelled")


def _is_complete(store: Path) -> bool:
    try:
        return bool(root_of(files_at(store))["attributes"]["complete"])
    except (NotAStore, CorruptStore, KeyError):
        return False
