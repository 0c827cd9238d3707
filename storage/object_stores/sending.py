"""PUT of one object at a signed address, which goes on for as long as bytes move.

A limit for a whole request is too short for many bytes on a slow link, or too long where the link
is gone: it is found out by the time for which no more bytes are taken.
"""

import hashlib
import mmap
import ssl
import time
from base64 import b64encode
from collections.abc import Iterator
from functools import lru_cache
from typing import Final

import httpx

from jointplay.storage.object_stores.taken import TAKEN

_TIMEOUT: Final = httpx.Timeout(5.0, write=30.0, read=300.0)
"""Seconds for a connection; without a byte taken; from the last byte, before which the system may
have yet to send some megabytes, to the answer."""
_PAUSES: Final = (1.0, 2.0, 4.0)
"""Seconds before an object is sent again that a store was too busy for."""
_BUSY: Final = frozenset({409, 429, 500, 502, 503, 504})
_PIECE: Final = 2**20  # bytes


def put_at(address: str, key: str, content: bytes | mmap.mmap, *, once: bool) -> None:
    """PUT an object, whose MD5 the store compares; `once` : if there is none of this key.

    Raises
    ------
    FileExistsError
        There is one.
    ConnectionError
        The store cannot be reached, is too busy, or refuses it.
    """
    md5 = hashlib.md5(content, usedforsecurity=False).digest()
    headers = {"Content-Length": str(len(content)), "Content-MD5": b64encode(md5).decode()}
    if once:
        headers["If-None-Match"] = "*"
    for pause in (*_PAUSES, None):
        try:
            answer = httpx.put(
                address,
                content=_pieces(content),
                headers=headers,
                timeout=_TIMEOUT,
                verify=_trusted(),
            )
        except httpx.TransportError as error:
            raise _failure(key, str(error) or type(error).__name__) from error
        if answer.is_success:
            return
        if once and answer.status_code == httpx.codes.PRECONDITION_FAILED:
            raise FileExistsError(f"results are written once: {key}")
        if pause is None or answer.status_code not in _BUSY:
            raise _failure(key, f"status {answer.status_code}")
        time.sleep(pause)


def _failure(key: str, reason: str) -> ConnectionError:
    return ConnectionError(f"the store of results does not take {key}: {reason}")


def _pieces(content: bytes | mmap.mmap) -> Iterator[bytes]:
    taken = TAKEN.get()
    for at in range(0, len(content), _PIECE):
        yield content[at : at + _PIECE]
        taken()


@lru_cache(maxsize=1)
def _trusted() -> ssl.SSLContext:
    context = httpx.create_ssl_context()
    context.load_default_certs()  # those of the system, too: a store may have its lab's
    return context
