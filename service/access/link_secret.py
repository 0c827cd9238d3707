"""The secret that links are signed with. It is kept beside the results that they open.

Whoever can read it can read the results, and a copy of the catalogue alone makes no links.
"""

import re
import secrets
from contextlib import suppress
from threading import Lock
from typing import Final

from jointplay.service.problems import unavailable
from jointplay.storage.installation import LINK_SIGNER
from jointplay.storage.object_stores import ObjectStore

_BYTES: Final = 32
_FORM: Final = re.compile(rf"[0-9a-f]{{{2 * _BYTES}}}")


class LinkSecret:
    """The secret of one object store, made when the first link is; all APIs have the same."""

    def __init__(self, store: ObjectStore) -> None:
        self._store = store
        self._known: bytes | None = None
        self._lock = Lock()

    @property
    def known(self) -> bytes | None:
        """The secret, if it was read before."""
        return self._known

    def read(self) -> bytes | None:
        """Return the secret; none: no link was ever made.

        Raises
        ------
        RequestRefused
            503: the object store cannot be read, or the secret is damaged.
        """
        with self._lock:
            if self._known is None:
                self._known = self._stored()
            return self._known

    def made(self) -> bytes:
        """Return the secret, made and stored if there is none; raises what `read` does."""
        while (known := self.read()) is None:
            try:
                with suppress(FileExistsError):  # another API was quicker
                    self._store.put(LINK_SIGNER, [secrets.token_hex(_BYTES).encode()])
            except OSError as fault:
                raise unavailable("The secret of links cannot be stored.", 30) from fault
        return known

    def _stored(self) -> bytes | None:
        try:
            text = self._store.read(LINK_SIGNER, 0, 4 * _BYTES).decode(errors="replace").strip()
        except FileNotFoundError:
            return None
        except OSError as fault:
            raise unavailable("The secret of links cannot be read.", 30) from fault
        if not _FORM.fullmatch(text):
            raise unavailable(f"The secret of links, {LINK_SIGNER}, is damaged; remove it.", 30)
        return bytes.fromhex(text)
