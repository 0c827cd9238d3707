"""Whether catalogue, results and machine agree: one file for each part, one function a check.

Checks read, and may be run while workers compute: nothing that a live lease holds is a finding.
"""

from collections.abc import Callable, Iterator
from typing import Final

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.reconciliation.extent import Counted, Extent
from jointplay.storage.reconciliation.finding import Finding
from jointplay.storage.reconciliation.leftovers import leftovers
from jointplay.storage.reconciliation.results import damage
from jointplay.storage.reconciliation.rows import inconsistencies, unsound
from jointplay.storage.reconciliation.solvers import unserved
from jointplay.storage.reconciliation.surroundings import clock, disk
from jointplay.storage.settings import Settings

__all__ = ["CHECKS", "Counted", "Extent", "Finding", "findings"]

Check = Callable[[Settings, Catalogue], Iterator[Finding]]
CHECKS: Final[tuple[Check, ...]] = (disk, clock, unserved, inconsistencies)
"""Checks that are made at once."""
_READ, _LEFT_OVER = 0.9, 0.99
"""Parts of the time after which results were read, and what is left over was looked for."""


def findings(
    settings: Settings,
    catalogue: Catalogue,
    more: tuple[Check, ...] = (),
    extent: Extent | None = None,
) -> Iterator[Finding]:
    """Yield everything that is not as it should be; nothing is mended by it.

    Parameters
    ----------
    settings, catalogue
        Of the installation.
    more
        Further checks, which only other packages can make.
    extent
        How closely results are looked at, and who hears how far that is; by default at every byte.
    """
    extent = extent or Extent()
    flaws = [*unsound(settings, catalogue)]
    yield from flaws
    if flaws:
        return
    for check in CHECKS:
        extent.report(0.0, f"looking at {check.__name__}")
        yield from check(settings, catalogue)
    yield from damage(settings, catalogue, extent.within(0.0, _READ))
    yield from leftovers(settings, catalogue, extent.within(_READ, _LEFT_OVER - _READ))
    for check in more:
        extent.report(_LEFT_OVER, f"looking at {check.__name__.replace('_', ' ')}")
        yield from check(settings, catalogue)
