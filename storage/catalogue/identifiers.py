"""Job ids: 26 characters that sort by time of creation (ULID)."""

import secrets
import threading

_ALPHABET = "0123456789ABCDEFGHJKMNPQRSTVWXYZ"
_RANDOM_BITS = 80


class Identifiers:
    """Makes ids: 48 bits of milliseconds, 80 random ones; later ids of a process sort later."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._last = 0

    def next(self, now: float) -> str:
        """Return a new id for the time `now` (epoch seconds)."""
        fresh = (int(now * 1000) << _RANDOM_BITS) | secrets.randbits(_RANDOM_BITS)
        with self._lock:
            # within one millisecond, or when the clock stepped back, count on from the last id
            milliseconds_passed = fresh >> _RANDOM_BITS > self._last >> _RANDOM_BITS
            self._last = fresh if milliseconds_passed else self._last + 1
            return _encode(self._last)


def earliest(time: float) -> str:
    """Return what no id made before a time (epoch seconds) is beyond, and no later one below."""
    milliseconds = min(max(int(time * 1000), 0), (1 << 48) - 1)
    return _encode(milliseconds << _RANDOM_BITS)


def time_of(identifier: str) -> float:
    """Return when an id was made, epoch seconds."""
    number = 0
    for character in identifier:
        number = number << 5 | _ALPHABET.index(character)
    return (number >> _RANDOM_BITS) / 1000.0


def _encode(number: int) -> str:
    return "".join(_ALPHABET[(number >> shift) & 31] for shift in range(125, -5, -5))
