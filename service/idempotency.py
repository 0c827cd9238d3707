"""``Idempotency-Key``: a request that is sent again finds what the first one made."""

import hashlib
import json
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Annotated

from fastapi import Depends, Header, Request

from jointplay.service.problems import RequestRefused, kinds
from jointplay.storage.catalogue.records import SubmissionKey

_HEADER = "Idempotency-Key"


class Repeatable:
    """A request that may carry a key."""

    def __init__(self, request: Request, key: str | None) -> None:
        self._path = request.url.path
        self._key = key
        self._in_flight: InFlight = request.app.state.in_flight

    @contextmanager
    def key_for(self, document: object) -> Iterator[SubmissionKey | None]:
        """Yield what to store with what this document makes; one request at a time has a key.

        Raises
        ------
        RequestRefused
            409 while another request with this key is being answered.
        """
        if self._key is None:
            yield None
            return
        body = json.dumps([self._path, document], sort_keys=True, separators=(",", ":"))
        fingerprint = hashlib.sha256(body.encode("utf-8", "surrogatepass")).hexdigest()
        with self._in_flight.holding(self._key):
            yield SubmissionKey(self._key, fingerprint)


class InFlight:
    """The keys of the requests that are being answered."""

    def __init__(self) -> None:
        self._keys: set[str] = set()
        self._lock = threading.Lock()

    @contextmanager
    def holding(self, key: str) -> Iterator[None]:
        """Hold a key while the block runs."""
        with self._lock:
            taken = key in self._keys
            self._keys.add(key)
        if taken:
            sentence = "A request with this key is being answered; send it again in a moment."
            raise RequestRefused.of_parameter(
                _HEADER, sentence, kinds.KEY_IN_FLIGHT, headers={"Retry-After": "1"}
            )
        try:
            yield
        finally:
            with self._lock:
                self._keys.discard(key)


async def _repeatable(
    request: Request,
    idempotency_key: Annotated[
        str | None,
        Header(
            alias=_HEADER,
            min_length=1,
            max_length=255,
            pattern=r"^[\x21-\x7e]+$",
            description="A text of the client's own, such as a UUID: for 24 hours a request with "
            "the same key and body is answered with what the first one made.",
        ),
    ] = None,
) -> Repeatable:
    return Repeatable(request, idempotency_key)


RepeatableRequest = Annotated[Repeatable, Depends(_repeatable)]
