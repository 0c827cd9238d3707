"""Whose turn it is: owners that have work waiting in one queue are served alike.

Start-time fair queueing (Goyal, Vin & Cheng, IEEE/ACM Trans. Networking 5, 1997) with blocks of
equal cost: a block's turn is the later of the queue's time, which is the turn of the last block
that was claimed, and the turn after its owner's last one. So owners that wait come one after the
other however many blocks each has, and whoever did not wait has saved up nothing. Work of nobody
has the queue's time as its turn: it comes in the order in which it was submitted.
"""

from collections import Counter
from collections.abc import Sequence
from itertools import count

from sqlalchemy import select, text, update

from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit

_turn = tables.turn
_BEGIN = text("INSERT INTO turn VALUES (:queue, '', 0) ON CONFLICT (queue, owner) DO NOTHING")
_TAKE = text(
    "INSERT INTO turn VALUES (:queue, :owner, :time + :count) ON CONFLICT (queue, owner) DO UPDATE"
    " SET next = CASE WHEN turn.next > :time THEN turn.next ELSE :time END + :count RETURNING next"
)


def take(unit: Unit, queued: Sequence[tuple[str, str]]) -> list[int]:
    """Return the turns of new blocks, by their queues and owners, in order of submission."""
    of_queues = select(_turn.c.queue, _turn.c.next).where(_turn.c.owner == "")
    times = {row.queue: row.next for row in unit.execute(of_queues)}
    own = {}
    for (queue, owner), blocks in sorted(Counter(one for one in queued if one[1]).items()):
        if queue not in times:
            times[queue] = 0
            unit.execute(_BEGIN, {"queue": queue})
        asked = {"queue": queue, "owner": owner, "time": times[queue], "count": blocks}
        own[queue, owner] = count(unit.execute(_TAKE, asked).scalar_one() - blocks)
    return [next(own[one]) if one in own else times.get(one[0], 0) for one in queued]


def pass_by(unit: Unit, queue: str, turn: int) -> None:
    """Let a queue's time go on to the turn of a block that was claimed."""
    of_queue = (_turn.c.queue == queue) & (_turn.c.owner == "") & (_turn.c.next < turn)
    unit.execute(update(_turn).where(of_queue).values(next=turn))
