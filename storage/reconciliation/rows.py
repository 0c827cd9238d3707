"""The catalogue against itself."""

import time
from collections.abc import Iterator
from functools import partial

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.inconsistencies import INCONSISTENCIES, Inconsistency, Patience
from jointplay.storage.reconciliation.finding import Finding
from jointplay.storage.settings import Settings

WHERE = "catalogue"
_RESTORE = "stop the service, put a backup of the catalogue back, and run this again"
_BEAT = 1.0  # s that a heartbeat may take on a busy machine
_HOPELESS = "jointplay cancel {0}; jointplay show {0} --job > job.json; jointplay submit job.json"


def unsound(settings: Settings, catalogue: Catalogue) -> Iterator[Finding]:
    """Look for reasons for which nothing else can be asked of the catalogue."""
    name = settings.catalogue_url.rpartition("/")[2]
    for flaw in catalogue.flaws():
        broken = flaw.startswith(("is damaged", "cannot be read", "lacks"))
        yield Finding(WHERE, (name,), flaw, advice=_RESTORE if broken else None)


def inconsistencies(settings: Settings, catalogue: Catalogue) -> Iterator[Finding]:
    """Look for inconsistent rows."""
    patience = Patience(settings.lease, settings.republish_after, settings.max_attempts)
    for kind in INCONSISTENCIES:
        subjects = catalogue.inconsistent(kind, patience)
        if subjects and kind.settles:
            time.sleep(settings.heartbeat + _BEAT)
            subjects = catalogue.inconsistent(kind, patience)
        if subjects:
            yield _finding(catalogue, kind, patience, subjects)


def _finding(
    catalogue: Catalogue, kind: Inconsistency, patience: Patience, subjects: tuple[str, ...]
) -> Finding:
    named = (f"{kind.subject} {subjects[0]}", *subjects[1:])
    if kind.mend is None:
        return Finding(WHERE, named, kind.found, advice=_HOPELESS.format(subjects[0]))
    return Finding(
        WHERE, named, kind.found, kind.mended, mend=partial(catalogue.reconcile, kind, patience)
    )
