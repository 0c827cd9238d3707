"""Whose turn it is: owners with work waiting in one queue get equal shares of the workers' time.

Start-time fair queueing (Goyal, Vin & Cheng, IEEE/ACM Trans. Networking 5, 1997) of work whose cost
is known afterwards (Mace et al., 2DFQ, SIGCOMM 2016): a claim charges its owner what his blocks
have cost lately, and once the attempt has ended the relay corrects that to the seconds that it
took. The owner who has been charged least comes first. Whoever had nothing waiting begins where the
queue is, which is where the owner of the last claim was: he has saved up nothing. Blocks that were
given back or lost, and those that seal a study, are charged with batches and studies.
"""

from collections.abc import Collection
from typing import Final

from sqlalchemy import bindparam, select, text, update

from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.records import FRESH_QUEUE, RECOVERED_QUEUE

_share = tables.share
_PART: Final = 0.25
"""Weight of the newest costs in the mean that the next block is charged."""
_AT_ONCE: Final = 1000
"""Attempts that are settled in one unit."""
_TIME = "coalesce((SELECT max(began) FROM share WHERE queue = :queue), 0)"
# Nothing is written, and nobody waited for, where he has work waiting or is not behind.
_ARRIVE = text(
    "INSERT INTO share (queue, owner, began, next)"  # noqa: S608 - our own names
    f" SELECT CAST(:queue AS varchar), CAST(:owner AS varchar), 0, {_TIME}"
    " WHERE NOT EXISTS (SELECT block FROM outbox WHERE queue = :queue AND owner = :owner)"
    " AND NOT EXISTS (SELECT owner FROM share"
    f" WHERE queue = :queue AND owner = :owner AND next >= {_TIME})"
    " ON CONFLICT (queue, owner) DO UPDATE"
    " SET next = CASE WHEN share.next < excluded.next THEN excluded.next ELSE share.next END"
)
_WAITING = text(  # one look at the index for each owner, however many blocks he has
    """
    WITH RECURSIVE waiting(owner) AS (
      SELECT min(owner) FROM outbox WHERE queue = :queue
      UNION ALL
      SELECT (SELECT min(outbox.owner) FROM outbox
        WHERE queue = :queue AND outbox.owner > waiting.owner)
      FROM waiting WHERE waiting.owner IS NOT NULL)
    SELECT waiting.owner FROM waiting
    LEFT JOIN share ON share.queue = :account AND share.owner = waiting.owner
    WHERE waiting.owner IS NOT NULL ORDER BY coalesce(share.next, 0), waiting.owner
    """
)
_of_owner = (_share.c.queue == bindparam("account")) & (_share.c.owner == bindparam("of_owner"))
_CHARGE = (
    update(_share)
    .where(_of_owner)
    .values(began=_share.c.next, next=_share.c.next + _share.c.cost)
    .returning(_share.c.cost)
)
_SETTLE = text(
    "INSERT INTO share (queue, owner, began, next, cost)"  # noqa: S608 - our own names
    f" VALUES (CAST(:queue AS varchar), CAST(:owner AS varchar), 0, {_TIME} + :more, :mean)"
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


def account_of(queue: str) -> str:
    """Return the queue whose shares a block is charged to."""
    return FRESH_QUEUE if queue == RECOVERED_QUEUE else queue


def arrive(unit: Unit, places: Collection[tuple[str, str]]) -> None:
    """Let owners begin where the queue is: before they have blocks, by queue and owner, wait."""
    for queue, owner in sorted(set(places)):
        unit.execute(_ARRIVE, {"queue": queue, "owner": owner})


def in_turn(unit: Unit, queue: str) -> list[str]:
    """Return the owners with blocks that wait in a queue, in the order of their turn."""
    asked = {"queue": queue, "account": account_of(queue)}
    return list(unit.execute(_WAITING, asked).scalars())


def charge(unit: Unit, account: str, owner: str) -> float:
    """Charge an owner what a block will probably cost; return the seconds."""
    charged = unit.execute(_CHARGE, {"account": account, "of_owner": owner}).scalar_one_or_none()
    return float(charged or 0.0)


def settle(unit: Unit) -> None:
    """Correct what was charged for attempts that have ended by the seconds that they took.

    By the relay, now and then: workers that end blocks of one owner would wait for each other.
    """
    rows = unit.execute(_ENDED).all()
    if rows:
        keys = [{"of_block": row.block, "of_number": row.number} for row in rows]
        unit.execute(_IS_SETTLED, keys)
    took: dict[tuple[str, str], list[tuple[float, float]]] = {}
    for row in rows:
        seconds = max(row.ended - row.started, 0.0)
        took.setdefault((row.account, row.owner), []).append((seconds, row.charged))
    for (queue, owner), some in sorted(took.items()):
        spent = sum(seconds for seconds, _ in some)
        more = spent - sum(charged for _, charged in some)
        paid = {"queue": queue, "owner": owner, "more": more, "mean": spent / len(some)}
        unit.execute(_SETTLE, paid)
