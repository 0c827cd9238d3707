"""Whether catalogue, results and machine agree: one file for each part, one function a check.

Checks read, and may be run while workers compute: nothing that a live lease holds is a finding.
"""

from collections.abc import Callable, Iterator
from typing import Final

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.reconciliation.finding import Finding
from jointplay.storage.reconciliation.leftovers import leftovers
from jointplay.storage.reconciliation.results import damage
from jointplay.storage.reconciliation.rows import contradictions, unsound
from jointplay.storage.reconciliation.solvers import unserved
from jointplay.storage.reconciliation.surroundings import clock, disk
from jointplay.storage.settings import Settings

__all__ = ["CHECKS", "Finding", "findings"]

Check = Callable[[Settings, Catalogue], Iterator[Finding]]
CHECKS: Final[tuple[Check, ...]] = (disk, clock, unserved, contradictions, damage, leftovers)


def findings(
    settings: Settings,
    catalogue: Catalogue,
    more: tuple[Check, ...] = (),
    report: Callable[[float, str], None] = lambda fraction, note: None,
) -> Iterator[Finding]:
    """Yield everything that is not as it should be; nothing is mended by it.

    Parameters
    ----------
    settings, catalogue
        Of the installation.
    more
        Further checks, which only other packages can make.
    report
        Called before each check with the part of all that are done, and its name.
    """
    flaws = [*unsound(settings, catalogue)]
    yield from flaws
    checks = () if flaws else (*CHECKS, *more)
    for done, check in enumerate(checks):
        report(done / len(checks), f"looking at {check.__name__.replace('_', ' ')}")
        yield from check(settings, catalogue)
