"""Keys of the service: who may ask it what. Their secrets are not stored, only digests of them.

A key is a text ``jp_ID_SECRET``; the id names its row, and the secret has 256 random bits, so that
a plain SHA-256 of the whole can neither be guessed nor turned round.
"""

import hmac
import re
import secrets
from collections.abc import Sequence
from dataclasses import dataclass
from hashlib import sha256
from typing import Final

from sqlalchemy import insert, select, update

from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.errors import KeyNotFound

SCOPES: Final = ("jobs:write", "jobs:read", "results:read", "worker", "metrics", "admin")
"""Permissions of keys; `worker` is to compute everybody's jobs, `admin` is all of them."""
OWNER: Final = re.compile(r"[a-z0-9][a-z0-9._@-]{0,63}")
"""Names of owners: their jobs are seen by keys of the same owner."""
ID: Final = re.compile(r"[0-9a-f]{8}")
_TEXT: Final = re.compile(rf"jp_({ID.pattern})_[A-Za-z0-9_-]{{43}}")
_table = tables.api_key


@dataclass(frozen=True, kw_only=True)
class Key:
    """A key without its secret. Times are epoch seconds."""

    id: str
    sha256: str
    owner: str
    scopes: frozenset[str]
    note: str
    created: float
    expires: float | None
    revoked: float | None
    last_used: float | None

    def lives(self, now: float) -> bool:
        """Whether it opens anything now."""
        return self.revoked is None and (self.expires is None or self.expires > now)

    def is_of(self, text: str) -> bool:
        """Whether a text is this key."""
        return hmac.compare_digest(sha256(text.encode()).hexdigest(), self.sha256)


def id_in(text: str) -> str | None:
    """Return the id that a key names; none if a text is no key."""
    found = _TEXT.fullmatch(text)
    return None if found is None else found[1]


def make_key(
    unit: Unit, owner: str, scopes: Sequence[str], note: str, seconds: float | None
) -> tuple[str, Key]:
    """Make a key that lasts for some seconds, or until it is revoked. Returns its text, too.

    Raises
    ------
    ValueError
        The owner or a scope is none that there can be.
    """
    if not OWNER.fullmatch(owner):
        raise ValueError(f"{owner!r} is no owner: a name has 1 to 64 of a-z, 0-9, and . _ @ -")
    if not scopes or set(scopes) - set(SCOPES):
        raise ValueError(f"the scopes are {', '.join(SCOPES)}; not {', '.join(scopes)!r}")
    name = secrets.token_hex(4)
    text = f"jp_{name}_{secrets.token_urlsafe(32)}"
    key = Key(
        id=name,
        sha256=sha256(text.encode()).hexdigest(),
        owner=owner,
        scopes=frozenset(scopes),
        note=note,
        created=unit.now,
        expires=None if seconds is None else unit.now + seconds,
        revoked=None,
        last_used=None,
    )
    unit.execute(insert(_table).values(vars(key) | {"scopes": " ".join(sorted(key.scopes))}))
    return text, key


def find_key(unit: Unit, key_id: str) -> Key:
    """Return a key by its id; KeyNotFound if there is none."""
    row = unit.execute(select(_table).where(_table.c.id == key_id)).one_or_none()
    if row is None:
        raise KeyNotFound(key_id)
    return Key(**{**row._mapping, "scopes": frozenset(row.scopes.split())})


def all_keys(unit: Unit) -> tuple[Key, ...]:
    """Return every key, oldest first, those that open nothing any more too."""
    rows = unit.execute(select(_table).order_by(_table.c.created, _table.c.id))
    return tuple(Key(**{**row._mapping, "scopes": frozenset(row.scopes.split())}) for row in rows)


def revoke_key(unit: Unit, key_id: str) -> Key:
    """Have a key open nothing from now on; KeyNotFound if there is none."""
    unrevoked = (_table.c.id == key_id) & _table.c.revoked.is_(None)
    unit.execute(update(_table).where(unrevoked).values(revoked=unit.now))
    return find_key(unit, key_id)


def note_use(unit: Unit, key_id: str) -> None:
    """Remember that a key was used just now."""
    unit.execute(update(_table).where(_table.c.id == key_id).values(last_used=unit.now))
