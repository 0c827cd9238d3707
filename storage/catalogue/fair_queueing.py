"""Whose turn it is: owners with work waiting get equal shares of the workers' time.

Start-time fair queueing (Goyal, Vin & Cheng, IEEE/ACM Trans. Networking 5, 1997) of work whose cost
is known afterwards (Mace et al., 2DFQ, SIGCOMM 2016): a claim charges its owner what their blocks
have cost lately, and once the attempt has ended the relay corrects that to the seconds that it
took. The owner who has been charged least comes first. Whoever had nothing waiting begins where the
others are, which is where the owner of the last claim was: nothing was saved up.

What a worker had begun comes before all else. A job that came alone, for which somebody may be
waiting, comes before studies and batches, unless its owner has been charged `HEAD_START` more than
theirs: however many such jobs one owner submits, the studies of others go on.
"""

from collections.abc import Collection
from typing import Final

from sqlalchemy import bindparam, case, func, select, text, update

from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.records import (
    FRESH_QUEUE,
    INTERACTIVE_QUEUE,
    QUEUES,
    RECOVERED_QUEUE,
)

HEAD_START: Final = 60.0
"""Seconds of workers that jobs which came alone may be ahead of studies and batches of others."""
MOST_BEHIND: Final = 600.0
"""Seconds that an owner may be behind: while what is waiting fits no worker's solver, no more
than that is saved up."""
ACCOUNT: Final = FRESH_QUEUE
"""Name under which shares are kept, of all queues together."""
_share = tables.share
_PART: Final = 0.25
"""Weight of the newest costs in the mean that the next block is charged."""
_AT_ONCE: Final = 1000
"""Attempts that are settled in one unit."""
_TIME = f"coalesce((SELECT max(began) FROM share WHERE queue = '{ACCOUNT}'), 0)"  # noqa: S608 - our own names
# Nothing is written, and nobody waited for, where the owner has work waiting or is not behind.
_ARRIVE = text(
    "INSERT INTO share (queue, owner, began, next)"  # noqa: S608 - our own names
    f" SELECT '{ACCOUNT}', CAST(:owner AS varchar), 0, {_TIME}"
    f" WHERE NOT EXISTS (SELECT block FROM outbox WHERE queue IN {QUEUES} AND owner = :owner)"
    " AND NOT EXISTS (SELECT owner FROM share"
    f" WHERE queue = '{ACCOUNT}' AND owner = :owner AND next >= {_TIME})"
    " ON CONFLICT (queue, owner) DO UPDATE"
    " SET next = CASE WHEN share.next < excluded.next THEN excluded.next ELSE share.next END"
)
_SEEDS = " UNION ALL ".join(f"SELECT CAST('{queue}' AS varchar) AS queue" for queue in QUEUES)
_WAITING = text(  # one look at the index for each owner, however many blocks it has
    f"""
    WITH RECURSIVE waiting(queue, owner) AS (
      SELECT queue, (SELECT min(outbox.owner) FROM outbox WHERE outbox.queue = seeds.queue)
      FROM ({_SEEDS}) AS seeds
      UNION ALL
      SELECT queue, (SELECT min(outbox.owner) FROM outbox
        WHERE outbox.queue = waiting.queue AND outbox.owner > waiting.owner)
      FROM waiting WHERE waiting.owner IS NOT NULL)
    SELECT waiting.queue, waiting.owner FROM waiting
    LEFT JOIN share ON share.queue = '{ACCOUNT}' AND share.owner = waiting.owner
    WHERE waiting.owner IS NOT NULL
    ORDER BY waiting.queue <> '{RECOVERED_QUEUE}', coalesce(share.next, 0)
      + CASE waiting.queue WHEN '{INTERACTIVE_QUEUE}' THEN 0 ELSE {HEAD_START} END, waiting.owner
    """  # noqa: S608 - our own names
)
_of_owner = (_share.c.queue == ACCOUNT) & (_share.c.owner == bindparam("of_owner"))
_others = _share.alias()
_least = select(func.max(_others.c.began)).where(_others.c.queue == ACCOUNT)
_LEAST = func.coalesce(_least.scalar_subquery(), 0.0) - MOST_BEHIND
_BEGINS = case((_share.c.next < _LEAST, _LEAST), else_=_share.c.next)
_CHARGE = (
    update(_share)
    .where(_of_owner)
    .values(began=_BEGINS, next=_BEGINS + _share.c.cost)
    .returning(_share.c.cost)
)
_SETTLE = text(
    "INSERT INTO share (queue, owner, began, next, cost)"  # noqa: S608 - our own names
    f" VALUES ('{ACCOUNT}', CAST(:owner AS varchar), 0, {_TIME} + :more, :mean)"
    f" ON CONFLICT (queue, owner) DO UPDATE SET next = share.next + :more,"
    f" cost = share.cost + {_PART} * (:mean - share.cost)"
)
_attempt = tables.attempt
_ENDED = (
    select(_attempt, tables.job.c.owner)
    .join(tables.block, tables.block.c.id == _attempt.c.block)
    .join(tables.job, tables.job.c.id == tables.block.c.job)
    .where(tables.UNSETTLED, _attempt.c.ended.is_not(None))
    .limit(_AT_ONCE)
)
_IS_SETTLED = (
    update(_attempt)
    .where(_attempt.c.block == bindparam("of_block"), _attempt.c.number == bindparam("of_number"))
    .values(account=None)
)


def arrive(unit: Unit, owners: Collection[str]) -> None:
    """Let owners begin where the others are: before new blocks of theirs wait."""
    for owner in sorted(set(owners)):
        unit.execute(_ARRIVE, {"owner": owner})


def in_order(unit: Unit) -> list[tuple[str, str]]:
    """Return queues and owners with blocks that wait there, in the order of their turn."""
    return [(row.queue, row.owner) for row in unit.execute(_WAITING)]


def charge(unit: Unit, owner: str) -> float:
    """Charge an owner what a block will probably cost. Returns the seconds."""
    return float(unit.execute(_CHARGE, {"of_owner": owner}).scalar_one_or_none() or 0.0)


def settle(unit: Unit) -> None:
    """Correct what was charged for attempts that have ended by the seconds that they took.

    By the relay, now and then: workers that end blocks of one owner would wait for each other.
    """
    rows = unit.execute(_ENDED).all()
    if rows:
        keys = [{"of_block": row.block, "of_number": row.number} for row in rows]
        unit.execute(_IS_SETTLED, keys)
    took: dict[str, list[tuple[float, float]]] = {}
    for row in rows:
        seconds = max(row.ended - row.started, 0.0)
        took.setdefault(row.owner, []).append((seconds, row.charged))
    for owner, some in sorted(took.items()):
        spent = sum(seconds for seconds, _ in some)
        more = spent - sum(charged for _, charged in some)
        paid = {"owner": owner, "more": more, "mean": spent / len(some)}
        unit.execute(_SETTLE, paid)
