"""Quotas of owners: jobs that have not ended, bytes of results, core seconds of a day.

What an owner has is counted in the unit that would add to it.
"""

from collections.abc import Collection
from dataclasses import astuple, dataclass

from sqlalchemy import Select, func, select

from jointplay.storage.catalogue import stored, tables, usage
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.databases.postgresql import lock_numbers
from jointplay.storage.catalogue.errors import QuotaExceeded
from jointplay.storage.catalogue.numbers import number_of
from jointplay.storage.catalogue.records import LIVE, BlockState


@dataclass(frozen=True)
class Quota:
    """Limits of one owner; 0: none."""

    live: int = 0
    """Jobs that have not ended."""
    stored: int = 0
    """Bytes of results."""
    computed: float = 0.0
    """Core seconds, in the last 24 hours."""

    def __bool__(self) -> bool:
        """Whether anything is limited."""
        return any(astuple(self))


NO_QUOTA = Quota()


@dataclass
class Use:
    """Everything limited that an owner has, in the units of `Quota`."""

    live: int
    running: int
    """Blocks that are computed."""
    stored: int
    computed: float


def use_of(unit: Unit, owner: str) -> Use:
    """Count what an owner has."""
    columns = tables.job.c
    of_owner = columns.state.in_(LIVE) & (columns.owner == owner)
    live = unit.execute(select(func.count()).select_from(tables.job).where(of_owner)).scalar_one()
    running = running_of(unit, owner)
    return Use(live, running, stored.bytes_of(unit, owner), usage.core_seconds_of(unit, owner))


def running_of(unit: Unit, owner: str) -> int:
    """Return how many blocks of an owner are computed."""
    computed = _running().where(tables.job.c.owner == owner).subquery()
    found: int = unit.execute(select(func.count()).select_from(computed)).scalar_one()
    return found


def busy_owners(unit: Unit, most: int) -> tuple[str, ...]:
    """Return the owners of whose blocks `most` or more are computed; none if that is 0."""
    if not most:
        return ()
    owner = tables.job.c.owner
    by_owner = _running().where(owner != "").group_by(owner).having(func.count() >= most)
    return tuple(unit.execute(by_owner).scalars())


def _running() -> Select[tuple[str]]:
    """Select the owner of each block that is computed: by index, there are few."""
    owners = select(tables.job.c.owner).join(tables.block)
    return owners.where(tables.block.c.state == BlockState.running)


class Uses:
    """Use of owners who may not have more than their quotas.

    Made before a unit adds any jobs; units that add to the jobs of one owner take turns.
    """

    def __init__(self, unit: Unit, owners: Collection[str]) -> None:
        if owners:
            lock_numbers(unit.connection, *(number_of("live", owner) for owner in owners))
        self._uses = {owner: use_of(unit, owner) for owner in owners}

    def add(self, owner: str, more: int, quota: Quota) -> None:
        """Count further jobs; QuotaExceeded if they are more than their key's quota allows."""
        use = self._uses.get(owner)
        if use is None:
            return
        if quota.live and use.live + more > quota.live:
            raise QuotaExceeded(
                f"{owner} has {use.live} jobs that have not ended, and may have {quota.live};"
                f" this would be {more} more"
            )
        if quota.stored and use.stored >= quota.stored:
            raise QuotaExceeded(
                f"{owner} has {use.stored} bytes of results, and may have {quota.stored};"
                " delete jobs that are not needed any more"
            )
        if quota.computed and use.computed >= quota.computed:
            raise QuotaExceeded(
                f"{owner} has computed {_hours(use.computed)} in the last 24 hours, and may"
                f" compute {_hours(quota.computed)}; ask again in an hour"
            )
        use.live += more


def _hours(seconds: float) -> str:
    return f"{seconds / 3600.0:.3g} core-hours"
