"""One exchange with the service: send, repeat what was lost, turn failures into typed errors."""

import json
import os
import random
import uuid
from collections.abc import Callable, Iterator, Mapping
from datetime import UTC, datetime
from email.utils import parsedate_to_datetime
from typing import Any, Final
from urllib.parse import quote

import httpx
from httpx_sse import ServerSentEvent

from jointplay.client.errors import OVERLOADED, ClientError, ServiceFailure, Unreachable, error_from
from jointplay.client.network import Network

DEFAULT_URL = "http://127.0.0.1:8000"
_LOOPBACK = frozenset({"127.0.0.1", "localhost", "::1"})
_GONE = frozenset({404, 410})

LONGEST_ANSWER: Final = 300.0
"""Seconds: the service itself gives up after 240 on a window that it has to compile first."""

ATTEMPTS: Final = 5
FIRST_PAUSE: Final = 0.1  # s, doubled from attempt to attempt
LONGEST_PAUSE: Final = 60.0
"""Seconds: a service that asks for more patience than this is an error that the caller decides."""

_LOST: Final = (httpx.NetworkError, httpx.RemoteProtocolError)
"""A connection that broke or was refused; one that is silent for long is another thing."""


class Connection:
    """Keeps the address and the open sockets; knows problem documents but no resource.

    Every request can be repeated without harm: a POST carries an Idempotency-Key, by which the
    service finds what the first one made.

    Parameters
    ----------
    url, key
        Address of the service and the key to send; default JOINTPLAY_URL and JOINTPLAY_KEY.
    timeout
        Longest wait for one answer, s; for a connection at most a minute.
    network
        Makes the network of the connection from settings of httpx.
    """

    def __init__(
        self, url: str | None, key: str | None, timeout: float, network: Callable[..., Network]
    ) -> None:
        if url is None:
            url = os.environ.get("JOINTPLAY_URL", DEFAULT_URL)
        if key is None:
            key = os.environ.get("JOINTPLAY_KEY")
        self.url = url.rstrip("/")
        if not self.url.startswith(("http://", "https://")):
            sentence = (
                f"{url!r} is not an address such as {DEFAULT_URL}: it has no http:// in front."
            )
            raise ClientError(sentence)
        self._longest_answer = timeout
        self._longest_connect = min(timeout, LONGEST_PAUSE)
        self.headers = {} if key is None else {"Authorization": f"Bearer {key}"}
        try:
            # a proxy from the environment cannot reach this machine's own addresses
            self.trusts_environment = httpx.URL(self.url).host not in _LOOPBACK
            self.network = network(
                base_url=self.url,
                headers=self.headers,
                timeout=httpx.Timeout(timeout, connect=self._longest_connect),
                trust_env=self.trusts_environment,
            )
        except httpx.InvalidURL as error:
            raise ClientError(f"{url!r} is not an address such as {DEFAULT_URL}.") from error

    def get(self, path: str, query: Mapping[str, Any] | None = None) -> dict[str, Any]:
        """GET the JSON document at ``path``; parameters that are None are left out."""
        return document_in(self.content(path, query), self.url)

    def content(self, path: str, query: Mapping[str, Any] | None = None) -> bytes:
        """GET what is at ``path``, as bytes."""
        given = {name: value for name, value in (query or {}).items() if value is not None}
        return self._exchange("GET", path, params=given).content

    def post(
        self, path: str, document: object | None = None, idempotency_key: str | None = None
    ) -> dict[str, Any]:
        """POST a JSON document, or nothing, with an Idempotency-Key of its own if none is given."""
        headers = {"Idempotency-Key": idempotency_key or uuid.uuid4().hex}
        arguments: dict[str, Any] = {"headers": headers}
        if document is not None:
            headers["Content-Type"] = "application/json"
            # NaN passes here: the service says which field
            arguments["content"] = json.dumps(document).encode()
        return document_in(self._exchange("POST", path, **arguments).content, self.url)

    def delete(self, path: str) -> None:
        """DELETE ``path``."""
        self._exchange("DELETE", path)

    def events(self, path: str, silence: float) -> Iterator[ServerSentEvent]:
        """Yield the events of a stream; `Unreachable` after `silence` seconds without a byte."""
        try:
            yield from self.network.events(path, silence)
        except httpx.TransportError as error:
            raise self._unreachable(error) from error

    def _exchange(self, method: str, path: str, **arguments: Any) -> httpx.Response:
        lost = False
        for repetition in range(1, ATTEMPTS + 1):
            response, failure = self._once(method, path, **arguments)
            if response is not None:
                if response.is_success:
                    return response
                if lost and method == "DELETE" and response.status_code in _GONE:
                    return response  # it was deleted before its answer was lost
                if not _is_worth_repeating(response):
                    break
            elif not isinstance(failure, _LOST):
                break
            lost |= failure is not None
            pause = _pause_before(repetition, response)
            if repetition == ATTEMPTS or pause > LONGEST_PAUSE:
                break
            self.network.sleep(pause)
        if response is not None:
            raise error_from(response)
        if isinstance(failure, httpx.ReadTimeout):
            sentence = f"The service at {self.url} gave no answer in {self._longest_answer:g} s."
            raise Unreachable(sentence) from failure
        raise self._unreachable(failure) from failure

    def _once(
        self, method: str, path: str, **arguments: Any
    ) -> tuple[httpx.Response | None, httpx.TransportError | None]:
        try:
            return self.network.request(method, path, **arguments), None
        except (httpx.UnsupportedProtocol, httpx.InvalidURL) as error:
            raise ClientError(f"{self.url!r} is not an address such as {DEFAULT_URL}.") from error
        except httpx.TransportError as error:
            return None, error

    def _unreachable(self, error: httpx.TransportError | None) -> Unreachable:
        if isinstance(error, httpx.ConnectTimeout):
            sentence = f"{self.url} took no connection in {self._longest_connect:g} s"
            return Unreachable(f"{sentence}; it is very busy, or cannot be reached from here.")
        if isinstance(error, httpx.ConnectError):
            sentence = "start one with `jointplay serve` or give its URL."
            return Unreachable(f"No service answers at {self.url}; {sentence}")
        broke = f"The connection to {self.url} broke ({type(error).__name__})"
        return Unreachable(f"{broke}; the job itself goes on.")


def document_in(content: str | bytes, url: str) -> dict[str, Any]:
    """Return the JSON object that an answer of 200 is; `ServiceFailure` where it is none."""
    try:
        document = json.loads(content)
    except (ValueError, RecursionError):
        document = None
    if not isinstance(document, dict):
        sentence = f"What answers at {url} is no service of jointplay, but a proxy or a page."
        raise ServiceFailure(sentence)
    return document


def segment(text: str) -> str:
    """Return ``text`` as one segment of a path."""
    return quote(text, safe="")


def _is_worth_repeating(response: httpx.Response) -> bool:
    """Tell whether the service asks for the same request once more.

    Besides 429, 503 and 507 it does while it still answers an earlier request of the same key,
    which is what happens if only the connection was lost.
    """
    in_flight = response.request.method == "POST" and response.status_code == 409
    return response.status_code in OVERLOADED or (in_flight and "retry-after" in response.headers)


def _pause_before(repetition: int, response: httpx.Response | None) -> float:
    """Return how long to wait before a repetition, 1 for the first, s; infinite: too long.

    Without a response the connection was lost.  Clients that were turned away together do not come
    back in the same moment: what they wait is spread over half of the pause.
    """
    pause = FIRST_PAUSE * 2.0 ** (repetition - 1)
    asked = 0.0 if response is None else _asked_for(response.headers.get("retry-after", ""))
    if asked > LONGEST_PAUSE:
        return float("inf")
    jitter = random.uniform(0.5, 1.0)  # noqa: S311
    return asked + pause * jitter


def _asked_for(retry_after: str) -> float:
    """Return the seconds of a Retry-After header: a number, or a date (RFC 9110, 10.2.3)."""
    if retry_after.isdigit():
        return float(retry_after)
    try:
        moment = parsedate_to_datetime(retry_after)
    except ValueError:
        return 0.0
    zoned = moment if moment.tzinfo else moment.replace(tzinfo=UTC)
    return max((zoned - datetime.now(UTC)).total_seconds(), 0.0)
