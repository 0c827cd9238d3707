"""The machine that an installation is on: its clock and its disk."""

from collections.abc import Iterator
from datetime import UTC, datetime

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.reconciliation.finding import Finding
from jointplay.storage.settings import Settings

_ADVANCE = 5.0  # s that clocks of several machines may be apart


def clock(settings: Settings, catalogue: Catalogue) -> Iterator[Finding]:
    """Compare the clock with the newest event: it was set back, or had been ahead."""
    newest = catalogue.newest_event()
    behind = 0.0 if newest is None else newest - catalogue.clock()
    if behind > _ADVANCE:
        moment = datetime.fromtimestamp(catalogue.clock(), UTC)
        yield Finding(
            "clock",
            (f"{moment:%Y-%m-%d %H:%M:%S} UTC",),
            f"{behind:.0f} s before the newest event of the catalogue",
            advice="compare it with another clock, and set it",
        )


def disk(settings: Settings, catalogue: Catalogue) -> Iterator[Finding]:
    """Compare the room on the data folder's disk with what submissions ask for."""
    if not settings.data.is_dir():
        return  # nothing was kept on this machine yet
    lacking = settings.reserve - settings.room()
    if lacking > 0:
        yield Finding(
            "disk",
            (str(settings.data),),
            "has less room than twice JOINTPLAY_RESERVE: no job is accepted",
            advice=f"free {lacking / 1e6:.0f} MB, for example with jointplay delete",
        )
