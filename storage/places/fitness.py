"""Whether a place keeps the promises on which results rely, tried when a service starts."""

import secrets
from contextlib import suppress

from jointplay.storage.places import Place

_FIRST, _SECOND = b"0123456789", b"other"
_LARGE = bytes(2**22 + 1)
"""More than a bucket is sent as other small objects are."""


class Unfit(Exception):
    """A place breaks a promise; the sentence says which."""


def require_fit(place: Place, *, large: bool = True) -> None:
    """Put an object twice, look for it, read a part of it, and remove it.

    `large` : whether also a large one is put, which some places take in another way.

    Raises
    ------
    Unfit
        The second replaced the first, or what is there does not show at once.
    OSError
        The place cannot be reached, or not be written.
    """
    key = f"trial/{secrets.token_hex(8)}"
    place.put(key, [_FIRST])
    try:
        for other in [_SECOND, _LARGE] if large else [_SECOND]:
            with suppress(FileExistsError):
                place.put(key, [other])
                raise Unfit("it replaces objects: it does not heed If-None-Match of a PUT")
        if key not in place.list("trial/"):
            raise Unfit("its list lacks an object that was put")
        if place.read(key, 7, 10) != _FIRST[7:]:
            raise Unfit("a range of an object is not what was put")
    finally:
        place.remove(key)
    if place.version(key) is not None:
        raise Unfit("an object that was removed is still there")
