"""Large files that go right into the bucket of a service, where the worker can reach that."""

import hashlib
import logging
import time
from collections.abc import Iterable
from typing import Final

import httpx

from jointplay.storage.attempt_files import is_written_once
from jointplay.storage.catalogue.records import Block
from jointplay.worker.joined.connection import Connection, is_local, is_private
from jointplay.worker.joined.protocol import Drop

_LARGE: Final = 2**20
"""Bytes of a file that is worth two requests more."""
_AGAIN: Final = 300.0
"""Seconds after which a bucket that there was not, or that could not be used, is tried again."""
_TIMEOUT: Final = httpx.Timeout(60.0, connect=5.0)
_log = logging.getLogger(__name__)


class BucketOfService:
    """Puts files where the service says; what cannot be put there is to be sent to the service.

    The key of the worker does not go to the bucket: an address is signed for one object.
    """

    def __init__(self, connection: Connection) -> None:
        self._connection = connection
        self._next = 0.0

    def put(self, block: Block, name: str, pieces: Iterable[bytes], size: int, digest: str) -> bool:
        """Put a file with the SHA-256 `digest`. Returns whether the service took it.

        The pieces are gone through more than once.
        """
        if size < _LARGE or not is_written_once(name) or time.monotonic() < self._next:
            return False
        md5 = hashlib.md5(usedforsecurity=False)
        for piece in pieces:
            md5.update(piece)
        told = Drop(name=name, size=size, sha256=digest, md5=md5.hexdigest())
        address = self._connection.offered(block, told)
        if (
            address is not None
            and self._sent(address, pieces, size)
            and self._connection.taken(block, told)
        ):
            return True
        self._next = time.monotonic() + _AGAIN
        return False

    def _sent(self, address: str, pieces: Iterable[bytes], size: int) -> bool:
        headers = {"Content-Length": str(size)}
        host = ""
        try:
            url = httpx.URL(address)
            host = url.host
            if not is_private(url):
                _log.warning("nothing is put at %s, which is not reached by https", host)
                return False
            answer = httpx.put(
                url,
                content=pieces,
                headers=headers,
                timeout=_TIMEOUT,
                trust_env=not is_local(url),
            )
            reason = f"status {answer.status_code}"
        except (httpx.TransportError, httpx.InvalidURL) as error:
            reason = str(error) or type(error).__name__
        else:
            if answer.is_success:
                return True
        _log.warning("files go through the service, since %s takes none: %s", host, reason)
        return False
