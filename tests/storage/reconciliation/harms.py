"""Harms that happen to an object of an installation."""

from collections.abc import Callable

from jointplay.storage.object_stores import StoredObject

Harm = Callable[..., None]


def content_of(stored: StoredObject) -> bytes:
    return stored.read(0, stored.size())


def write(stored: StoredObject, content: bytes) -> None:
    stored.object_store.replace(stored.key, [content])


def flip(stored: StoredObject, _: StoredObject | None = None) -> None:
    content = bytearray(content_of(stored))
    content[len(content) // 2] ^= 1
    write(stored, bytes(content))


def truncate(stored: StoredObject, _: StoredObject | None = None) -> None:
    write(stored, content_of(stored)[:-1])


def empty(stored: StoredObject, _: StoredObject | None = None) -> None:
    write(stored, b"")


def remove(stored: StoredObject, _: StoredObject | None = None) -> None:
    stored.object_store.remove(stored.key)


def swap(stored: StoredObject, other: StoredObject) -> None:
    """Exchange it with what is in its place in another job."""
    one, two = content_of(stored), content_of(other)
    write(stored, two)
    write(other, one)
