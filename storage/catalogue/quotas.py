"""Quotas: most jobs of one owner that have not ended, counted in the unit that adds to them."""

from collections.abc import Collection

from sqlalchemy import func, select

from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.databases.postgresql import take_turns
from jointplay.storage.catalogue.errors import QuotaExceeded
from jointplay.storage.catalogue.records import JobState, number_of

_LIVE = [state for state in JobState if not state.terminal]


class LiveJobs:
    """Numbers of jobs that have not ended, of owners that may have so many.

    Made before a unit adds any; units that add to the jobs of one owner take turns.
    """

    def __init__(self, unit: Unit, owners: Collection[str]) -> None:
        self._counts = dict.fromkeys(owners, 0)
        if not owners:
            return
        take_turns(unit.connection, *(number_of("live", owner) for owner in owners))
        columns = tables.job.c
        of_owners = columns.state.in_(_LIVE) & columns.owner.in_(owners)
        counted = select(columns.owner, func.count()).where(of_owners).group_by(columns.owner)
        self._counts |= dict(unit.execute(counted).all())

    def add(self, owner: str, more: int, most: int) -> None:
        """Count further jobs; QuotaExceeded if they would be more than `most` (0: any number)."""
        if owner not in self._counts:
            return
        live = self._counts[owner]
        if most and live + more > most:
            raise QuotaExceeded(owner, live, most, more)
        self._counts[owner] = live + more
