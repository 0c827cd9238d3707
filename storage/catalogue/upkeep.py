"""What relay and reaper need: blocks nobody was told of, leases that ran out, duties."""

from sqlalchemy import Connection, case, delete, func, select, update

from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.holding import RECOVERED_QUEUE, lose
from jointplay.storage.catalogue.records import BlockState, Reaped, WakeUp
from jointplay.storage.catalogue.submission import FRESH_QUEUE

_REAP_AT_ONCE = 200
_RAREST_REPEAT = 16  # a wake-up is repeated after at most so many times `republish_after`


def due_wake_ups(connection: Connection, outstanding: int, now: float) -> tuple[WakeUp, ...]:
    """Return what to publish now: due wake-ups, those of recovered blocks first.

    Only so many may be on their way at one time: what Redis holds stays small however many
    blocks wait, and losing it costs little.
    """
    outbox = tables.outbox
    on_the_way = connection.execute(
        select(func.count()).select_from(outbox).where(outbox.c.due > now)
    ).scalar_one()
    due: list[WakeUp] = []
    for queue in (RECOVERED_QUEUE, FRESH_QUEUE):  # by index: the cost is that of the answer
        rows = connection.execute(
            select(outbox.c.block)
            .where(outbox.c.queue == queue, outbox.c.due <= now)
            .order_by(outbox.c.due, outbox.c.block)
            .limit(max(outstanding - on_the_way - len(due), 0))
        )
        due += [WakeUp(block, queue) for block in rows.scalars()]
    return tuple(due)


def mark_published(
    connection: Connection, blocks: tuple[str, ...], republish_after: float, now: float
) -> None:
    """Remember that workers were told; a block still unclaimed later is due again."""
    outbox = tables.outbox
    patience = case((outbox.c.tries < _RAREST_REPEAT, outbox.c.tries + 1), else_=_RAREST_REPEAT)
    connection.execute(
        update(outbox)
        .where(outbox.c.block.in_(blocks))
        .values(tries=outbox.c.tries + 1, due=now + republish_after * patience)
    )


def reap(connection: Connection, max_attempts: int, now: float) -> Reaped:
    """Take back the blocks whose lease ran out, and forget idempotency keys past their time."""
    block = tables.block
    expired = connection.execute(
        select(block.c.id, block.c.attempt, block.c.job)
        .where(block.c.state == BlockState.running.value, block.c.lease_until < now)
        .order_by(block.c.lease_until, block.c.id)
        .limit(_REAP_AT_ONCE)
        .with_for_update(skip_locked=True)
    ).all()
    requeued, ended = [], []
    for row in expired:
        outcome = lose(connection, row.id, row.attempt, max_attempts, now)
        if outcome is BlockState.queued:
            requeued.append(row.id)
        else:
            ended.append(row.job)
    connection.execute(delete(tables.idempotency).where(tables.idempotency.c.expires <= now))
    return Reaped(tuple(requeued), tuple(ended))


def hold_duty(connection: Connection, name: str, holder: str, seconds: float, now: float) -> bool:
    """Take or keep a duty; false while somebody else has it."""
    duty = tables.duty
    taken = connection.execute(
        update(duty)
        .where(duty.c.name == name, (duty.c.holder == holder) | (duty.c.until <= now))
        .values(holder=holder, until=now + seconds)
    )
    return taken.rowcount == 1


def lay_down_duty(connection: Connection, name: str, holder: str, now: float) -> None:
    """Give a duty up, so that another process can take it at once."""
    duty = tables.duty
    connection.execute(
        update(duty).where(duty.c.name == name, duty.c.holder == holder).values(until=now)
    )
