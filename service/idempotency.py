"""``Idempotency-Key``: a request that is sent again finds what the first one made."""

import hashlib
import secrets
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Annotated, Self

from fastapi import Depends, Header, Request

from jointplay.service.access import CallerDependency
from jointplay.service.problems import RequestRefused, kinds
from jointplay.storage.catalogue.records import SubmissionKey

_HEADER = "Idempotency-Key"


@dataclass(frozen=True)
class SentKey:
    """The key of a request, before its body has arrived."""

    key: str
    owner: str
    path: str
    """Where it was sent; empty: the body need not be the same."""

    @classmethod
    def made_here(cls, owner: str) -> Self:
        """Return a key like no other, with the blank that no client's own has."""
        return cls(f" {secrets.token_hex(16)}", owner, path="")

    @classmethod
    def of_retry(cls, batch: str, jobs: Sequence[str], owner: str) -> Self:
        """Return the key of a retry of some jobs of a batch, which asked again finds the first."""
        asked = hashlib.sha256(" ".join([batch, *jobs]).encode()).hexdigest()
        return cls(f" retry {asked}", owner, path="")

    def with_body(self, body: bytes = b"") -> SubmissionKey:
        """Return what to store with what a body makes.

        What is sent again has the same bytes: to read a long document takes seconds, and another
        order of keys may make another job.
        """
        found = hashlib.sha256(self.path.encode() + b"\n" + body).hexdigest() if self.path else ""
        return SubmissionKey(self.key, found, owner=self.owner)


class Repeatable:
    """A request that may carry a key, which no other one may have while it is answered."""

    def __init__(self, request: Request, key: str | None, owner: str) -> None:
        self.sent_key = SentKey(key, owner, request.url.path) if key else None
        self._in_flight: dict[tuple[str, str], Repeatable] = request.app.state.in_flight

    @contextmanager
    def in_flight(self) -> Iterator[None]:
        """Hold the key; begun before the body is looked at, as its check may take long.

        Raises
        ------
        RequestRefused
            409 while another request with this key is being answered.
        """
        if self.sent_key is None:
            yield
            return
        held = self.sent_key.owner, self.sent_key.key
        if self._in_flight.setdefault(held, self) is not self:  # one step, for all threads
            sentence = "A request with this key is being answered; send it again in a moment."
            raise RequestRefused.of_parameter(
                _HEADER, sentence, kinds.KEY_IN_FLIGHT, headers={"Retry-After": "1"}
            )
        try:
            yield
        finally:
            del self._in_flight[held]


async def _repeatable(
    request: Request,
    caller: CallerDependency,
    idempotency_key: Annotated[
        str | None,
        Header(
            alias=_HEADER,
            min_length=1,
            max_length=255,
            pattern=r"^[\x21-\x7e]+$",
            description="A text of the client's own, such as a UUID: for 24 hours a request with "
            "the same key and the same bytes as body is answered with what the first one made.",
        ),
    ] = None,
) -> Repeatable:
    if len(request.headers.getlist(_HEADER)) > 1:
        sentence = "This header is there more than once; a request has one key."
        raise RequestRefused.of_parameter(_HEADER, sentence)
    return Repeatable(request, idempotency_key, caller.owner)


RepeatableRequest = Annotated[Repeatable, Depends(_repeatable)]
