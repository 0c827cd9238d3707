"""Whether an object store keeps the promises that results rely on, tried as a service starts."""

import secrets
from contextlib import suppress

from jointplay.storage.object_stores import ObjectStore

_FIRST, _SECOND = b"0123456789", b"other"
_LARGE = bytes(2**22 + 1)
"""More than a bucket is sent as other small objects are."""


class Unfit(Exception):
    """An object store breaks a promise; the sentence says which."""


def require_fit(store: ObjectStore, *, large: bool = True) -> None:
    """Put an object twice, look for it, read a part of it, and remove it.

    `large` : whether also a large one is put, which some stores take in another way.

    Raises
    ------
    Unfit
        The second replaced the first, or what is there does not show at once.
    OSError
        The store cannot be reached, or not be written.
    """
    key = f"trial/{secrets.token_hex(8)}"
    store.put(key, [_FIRST])
    try:
        for other in [_SECOND, _LARGE] if large else [_SECOND]:
            with suppress(FileExistsError):
                store.put(key, [other])
                raise Unfit("it replaces objects: it does not heed If-None-Match of a PUT")
        if key not in store.list("trial/"):
            raise Unfit("its list lacks an object that was put")
        if store.read(key, 7, 10) != _FIRST[7:]:
            raise Unfit("a range of an object is not what was put")
    finally:
        store.remove(key)
    if store.version(key) is not None:
        raise Unfit("an object that was removed is still there")
