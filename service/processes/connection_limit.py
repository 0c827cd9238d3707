"""The limit of connections: none is held for nothing, and one address cannot have all.

A connection that waits for a request makes room for a new one: one of the address that has most,
and of those that were never asked anything, unless more of the others wait.

Of many that come at once none was read yet, and any may have sent a request: a new one waits in
a queue until they were read. Then one that has sent no whole head makes room.
"""

import asyncio
from collections import Counter, OrderedDict
from itertools import islice
from typing import Final, Protocol

MOST: Final = 1024
"""Connections at once, if the system allows twice as many open files."""
SHARE: Final = 0.75
"""Part of them that one address may have."""
QUEUED: Final = 0.25
"""Connections that may wait in a queue besides, as a part of those that have room."""
LOOKS: Final = 5
"""Times that one of them looks for room; all others are read in between."""
LOOKED_AT: Final = 64
"""Idle connections of which one makes room: of many that come at once none was read yet."""
_BETWEEN_LOOKS = 0.05  # s


class LimitedConnection(Protocol):
    """A connection, of which nothing is read before it has room."""

    address: str

    @property
    def asked(self) -> bool:
        """Whether it has had a request before."""

    @property
    def unread(self) -> bool:
        """Whether the client has sent what was not looked at yet."""

    def end(self) -> None:
        """Leave, and close the connection: it waits for a request."""

    def begin(self) -> None:
        """Begin: there is room."""

    def refuse(self) -> None:
        """Tell the client that there is no room, and close the connection."""


class ConnectionLimit:
    """Connections at once: who has how many, and which of them wait for a request."""

    def __init__(self, most: int) -> None:
        self.most, self.of_one = most, max(1, int(SHARE * most))
        self._inside: set[LimitedConnection] = set()
        self._held: Counter[str] = Counter()
        self._idle: dict[tuple[str, bool], OrderedDict[LimitedConnection, None]] = {}
        """Those that wait, the longest first, by address and whether they were asked before."""
        self._queue: dict[LimitedConnection, asyncio.TimerHandle] = {}

    @property
    def held(self) -> int:
        """Connections that have room."""
        return len(self._inside)

    def __contains__(self, connection: LimitedConnection) -> bool:
        """Whether a connection has room."""
        return connection in self._inside

    def admit(self, connection: LimitedConnection) -> None:
        """Let a connection in, as soon as there is room, or refuse it.

        Others make room, if need be, that are idle; in the queue the one that waits longest does.
        """
        if self._enters(connection):
            return
        if len(self._queue) >= max(1, int(QUEUED * self.most)):
            longest = next(iter(self._queue))
            self.leave(longest)
            longest.refuse()
        self._look_later(connection, LOOKS)

    def _enters(self, connection: LimitedConnection) -> bool:
        address = connection.address
        crowded = self._held[address] >= self.of_one
        if crowded or self.held >= self.most:
            idle = self._longest_idle(address if crowded else self._crowd())
            if idle is None:
                return False
            idle.end()
        self._inside.add(connection)
        self._held[address] += 1
        self.rest(connection)
        connection.begin()
        return True

    def _look_later(self, connection: LimitedConnection, looks: int) -> None:
        self._queue[connection] = asyncio.get_running_loop().call_later(
            _BETWEEN_LOOKS, self._look, connection, looks
        )

    def _look(self, connection: LimitedConnection, looks: int) -> None:
        if self._enters(connection):
            del self._queue[connection]
        elif looks > 1:
            self._look_later(connection, looks - 1)
        else:
            self.leave(connection)
            connection.refuse()

    def leave(self, connection: LimitedConnection) -> None:
        """Forget a connection, wherever it is."""
        timer = self._queue.pop(connection, None)
        if timer is not None:
            timer.cancel()
        if connection not in self:
            return
        self.work(connection)
        self._inside.remove(connection)
        self._held[connection.address] -= 1
        if not self._held[connection.address]:
            del self._held[connection.address]

    def rest(self, connection: LimitedConnection) -> None:
        """Note that a connection waits for a request."""
        self.work(connection)
        whose = connection.address, connection.asked
        self._idle.setdefault(whose, OrderedDict())[connection] = None

    def work(self, connection: LimitedConnection) -> None:
        """Note that a connection has a request, or is gone."""
        for asked in (False, True):
            idle = self._idle.get((connection.address, asked), OrderedDict())
            idle.pop(connection, None)
            if not idle:
                self._idle.pop((connection.address, asked), None)

    def _crowd(self) -> str:
        """Return the address with most connections, of those that have an idle one."""
        return max((one for one, _ in self._idle), key=lambda one: self._held[one], default="")

    def _longest_idle(self, address: str) -> LimitedConnection | None:
        """Return one of an address that has waited long; those that wait no more go to the end."""
        none: OrderedDict[LimitedConnection, None] = OrderedDict()
        new, others = (self._idle.get((address, asked), none) for asked in (False, True))
        idle = new if len(new) >= len(others) else others
        for one in [*islice(idle, LOOKED_AT)]:
            if not one.unread:
                return one
            idle.move_to_end(one)
        return None
