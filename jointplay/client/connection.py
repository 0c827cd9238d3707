"""One HTTP exchange with the service: send, and turn every failure into a typed error."""

import json
from collections.abc import Iterator, Mapping
from typing import Any
from urllib.parse import quote

import httpx

from jointplay.client.errors import (
    ClientError,
    FieldProblem,
    NotFound,
    Refused,
    ResultsNotReady,
    ServiceFailure,
    Unreachable,
)

DEFAULT_URL = "http://127.0.0.1:8000"
_LOOPBACK = frozenset({"127.0.0.1", "localhost", "::1"})


class Connection:
    """Keeps the address and the open sockets; knows problem documents but no resource."""

    def __init__(self, url: str, timeout: float, transport: httpx.BaseTransport | None) -> None:
        self.url = url.rstrip("/")
        try:
            self._http = httpx.Client(
                base_url=self.url,
                timeout=timeout,
                transport=transport,
                # a proxy from the environment cannot reach this machine's own addresses
                trust_env=httpx.URL(self.url).host not in _LOOPBACK,
            )
        except httpx.InvalidURL as error:
            raise ClientError(f"{url!r} is not an address such as {DEFAULT_URL}.") from error

    def close(self) -> None:
        """Close the sockets."""
        self._http.close()

    def get(self, path: str, query: Mapping[str, Any] | None = None) -> httpx.Response:
        """GET ``path``; parameters that are None are left out."""
        given = {name: value for name, value in (query or {}).items() if value is not None}
        return self._exchange("GET", path, params=given)

    def post(
        self,
        path: str,
        document: object | None = None,
        headers: Mapping[str, str] | None = None,
    ) -> httpx.Response:
        """POST a JSON document, or nothing."""
        if document is None:
            return self._exchange("POST", path)
        body = json.dumps(document).encode()  # NaN passes here: the service says which field
        sent = {"Content-Type": "application/json", **(headers or {})}
        return self._exchange("POST", path, content=body, headers=sent)

    def delete(self, path: str) -> httpx.Response:
        """DELETE ``path``."""
        return self._exchange("DELETE", path)

    def lines(self, path: str, silence: float) -> Iterator[str]:
        """Yield the lines of a stream; `Unreachable` after so many seconds without one."""
        timeout = httpx.Timeout(self._http.timeout.connect, read=silence)
        headers = {"Accept": "text/event-stream"}
        try:
            with self._http.stream("GET", path, headers=headers, timeout=timeout) as response:
                if not response.is_success:
                    response.read()
                    raise _error_from(response)
                yield from response.iter_lines()
        except httpx.TransportError as error:
            raise Unreachable(_unreachable(self.url, error)) from error

    def _exchange(self, method: str, path: str, **arguments: Any) -> httpx.Response:
        try:
            response = self._http.request(method, path, **arguments)
        except (httpx.UnsupportedProtocol, httpx.InvalidURL) as error:
            raise ClientError(f"{self.url!r} is not an address such as {DEFAULT_URL}.") from error
        except httpx.TransportError as error:
            raise Unreachable(_unreachable(self.url, error)) from error
        if response.is_success:
            return response
        raise _error_from(response)


def segment(text: str) -> str:
    """Return ``text`` as one segment of a path."""
    return quote(text, safe="")


def _unreachable(url: str, error: httpx.TransportError) -> str:
    if isinstance(error, httpx.ConnectError | httpx.ConnectTimeout):
        return f"No service answers at {url}; start one with `jointplay serve` or give its URL."
    return f"The connection to {url} broke ({type(error).__name__}); the job itself goes on."


def _error_from(response: httpx.Response) -> ClientError:
    problem = _problem_in(response)
    detail = str(problem.get("detail") or problem.get("title") or response.reason_phrase)
    if response.status_code >= 500:
        return ServiceFailure(f"The service failed with {response.status_code}: {detail}")
    kind = {404: NotFound, 409: ResultsNotReady}.get(response.status_code, Refused)
    return kind(
        detail,
        status=response.status_code,
        problem=str(problem.get("type", "")).rsplit("/", 1)[-1],
        fields=[
            FieldProblem(str(one.get("pointer") or one.get("parameter") or ""), one["detail"])
            for one in problem.get("errors") or ()
        ],
    )


def _problem_in(response: httpx.Response) -> dict[str, Any]:
    """Return the problem document, or an empty one when something else answered (a proxy)."""
    if response.headers.get("content-type", "").startswith("application/problem+json"):
        document = response.json()
        if isinstance(document, dict):
            return document
    return {}
