"""Signed links: an address that opens one job's stored arrays to whoever has it, without a header.

The token in the path names the job, the moment when the link ends, and the key that it was made
with; it is signed with the `link_secret` and what the catalogue has of that key. It lasts no longer
than the key. It stands in the path since stock Zarr clients put the keys of a store
behind the path of its address, and drop or misplace a query.
"""

import hmac
import struct
from base64 import urlsafe_b64decode, urlsafe_b64encode
from binascii import Error
from dataclasses import dataclass
from hashlib import sha256
from typing import Final, Self

from starlette.types import ASGIApp, Receive, Scope, Send

from jointplay.records.job import is_job_id
from jointplay.storage.catalogue.keys import ID, Key

PREFIX: Final = "/v1/shared/"
WHOLE: Final = "zarr.zip"
"""Address of the store in one file, behind a token; all others there are of its keys."""
SIGNED: Final = "jointplay.signed"
"""Where the scope of a request has its `Link`."""
_SIGNED: Final = struct.Struct(">26sQ8s")  # job, end as epoch seconds, id of the key
_LONGEST: Final = 4 * (_SIGNED.size + sha256().digest_size) // 3 + 4


@dataclass(frozen=True)
class Link:
    """Content of a token; nothing of it is true before `is_signed_with` says so."""

    job: str
    until: int
    key: str
    signature: bytes = b""

    @classmethod
    def of(cls, token: str) -> Self | None:
        """Return what a token says; none if it is no token."""
        if len(token) > _LONGEST:
            return None
        try:
            content = urlsafe_b64decode(token + "=" * (-len(token) % 4))
            job, until, key = _SIGNED.unpack(content[: _SIGNED.size])
            link = cls(job.decode("ascii"), until, key.decode("ascii"), content[_SIGNED.size :])
        except (Error, struct.error, ValueError):
            return None
        return link if is_job_id(link.job) and ID.fullmatch(link.key) else None

    def signed_with(self, secret: bytes, key: Key) -> str:
        """Return the token of this link; `secret` : that of all links, see `link_secret`."""
        content = self._content() + self._signature(secret, key)
        return urlsafe_b64encode(content).decode().rstrip("=")

    def is_signed_with(self, secret: bytes, key: Key, now: float) -> bool:
        """Whether it was signed so, for this key, and has not ended."""
        same = hmac.compare_digest(self._signature(secret, key), self.signature)
        return same and now < self.until

    def _signature(self, secret: bytes, key: Key) -> bytes:
        return hmac.digest(secret + bytes.fromhex(key.sha256), self._content(), "sha256")

    def _content(self) -> bytes:
        return _SIGNED.pack(self.job.encode(), self.until, self.key.encode())


class SignedLinks:
    """Leads ``/v1/shared/TOKEN/zarr...`` to the stored arrays of the job that a token names."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, at its job's address; authentication checks the link itself."""
        if scope["type"] == "http" and scope["path"].startswith(PREFIX):
            token, slash, behind = scope["path"][len(PREFIX) :].partition("/")
            link = Link.of(token)
            if link is not None and (behind == WHOLE or (behind + slash).startswith("zarr/")):
                path = f"/v1/jobs/{link.job}/{behind}"
                scope.update({"path": path, "raw_path": path.encode(), SIGNED: link})
        await self._app(scope, receive, send)
