"""Requests of a worker to the service that it joined, and what their refusals mean to it."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final, TypeVar
from urllib.parse import quote

import httpx
from pydantic import ValidationError

from jointplay.storage.catalogue.errors import CatalogueError, Fenced, Unavailable
from jointplay.storage.catalogue.records import Block, Claim, Solver
from jointplay.worker.holding import Refused
from jointplay.worker.joined.protocol import (
    ClaimBeside,
    Claimed,
    ClaimedBeside,
    ClaimRequest,
    Document,
    Drop,
    DropAt,
)

Answer = TypeVar("Answer", bound=Document)
_LOOPBACK: Final = frozenset({"127.0.0.1", "localhost", "::1"})
_CONNECT: Final = 5.0  # s
_TIMEOUT: Final = httpx.Timeout(20.0, connect=_CONNECT)
_PATIENCE: Final = 15.0  # s, beyond what a service may take to find a block
_LONGEST_TAKING: Final = 120.0  # s, in which a service reads and copies the largest file
_MAY_PASS: Final = frozenset({408, 422, 425, 429})  # 422: bytes that were changed on their way
_FULL: Final = 507
_OWN: Final = frozenset({"application/json", "application/octet-stream"})
"""Types of what a service answers; a page, whatever its status, is of a proxy."""
_REFUSED: Final = "/results-refused"
_LARGEST_KEY: Final = 4096


class ResultsRefused(Fenced):
    """The service found results that are not the block's, which it took back; see its sentence."""

    def __init__(self, block: Block, detail: str) -> None:
        sentence = f"attempt {block.attempt} at block {block.id} is refused: {detail}"
        CatalogueError.__init__(self, sentence)


class Connection:
    """One worker's exchanges with a service; may be used by several threads.

    Methods raise `Unavailable` for what may pass, `Fenced` if the block is another worker's, and
    `Refused` for what will not.

    Parameters
    ----------
    url
        Of the service; the key goes over HTTPS only, or to this machine.
    key
        With the scope `worker`; none for a service that asks for none.
    """

    def __init__(self, url: str, key: str | None) -> None:
        self.url = url.rstrip("/")
        try:
            parsed = httpx.URL(self.url)
        except httpx.InvalidURL as error:
            raise Refused(f"{url!r} is no address of a service: {error}") from error
        if not is_private(parsed):
            raise Refused(f"{url!r} must begin with https://; a key is sent there")
        headers = {} if key is None else {"Authorization": f"Bearer {key}"}
        self._http = httpx.Client(
            base_url=self.url, headers=headers, timeout=_TIMEOUT, trust_env=not is_local(parsed)
        )

    def close(self) -> None:
        """Close the sockets."""
        self._http.close()

    def claim(self, request: ClaimRequest) -> Claimed | None:
        """Wait for a block. Returns None if there was none in the time that the request says."""
        patient = httpx.Timeout(request.wait + _PATIENCE, connect=_CONNECT)
        with self._answering():
            response = self._http.post("/v1/worker/claims", **_json(request), timeout=patient)
        _require_success(response, None)
        if response.status_code == httpx.codes.NO_CONTENT:
            return None
        return answer_of(Claimed, response.content)

    def claim_beside(self, block: Block, solver: Solver, most: int) -> tuple[Claim, ...]:
        """Claim at most so many further blocks of the study of one that is held."""
        asked = ClaimBeside(**vars(solver), most=most)
        return answer_of(ClaimedBeside, self.report(block, "beside", asked)).claims

    def report(
        self,
        block: Block,
        what: str,
        document: Document | None = None,
        *,
        within: float | None = None,
    ) -> bytes:
        """POST something about a block that is held. Returns the answer.

        `Unavailable` also if there is none within some seconds, for what is of no use later.
        """
        limit = _TIMEOUT if within is None else httpx.Timeout(within, connect=min(within, _CONNECT))
        with self._answering():
            sent = {} if document is None else _json(document)
            response = self._http.post(f"{_path(block)}/{what}", **sent, timeout=limit)
        _require_success(response, block)
        return response.content

    def ask(self, block: Block, kind: type[Answer]) -> Answer:
        """GET the list of files of a block."""
        with self._answering():
            response = self._http.get(f"{_path(block)}/files")
        _require_success(response, block)
        return answer_of(kind, response.content)

    def read(self, block: Block, name: str) -> Iterator[bytes]:
        """GET a file in pieces; FileNotFoundError if it is gone."""
        with (
            self._answering(),
            self._http.stream("GET", f"{_path(block)}/files/{quote(name)}") as response,
        ):
            if not response.is_success:
                response.read()
                if _problem_of(response)[0].endswith("/not-found"):
                    raise FileNotFoundError(name)
            _require_success(response, block)
            yield from response.iter_bytes(2**20)

    def write(
        self, block: Block, name: str, content: Iterable[bytes], size: int, digest: str, offset: int
    ) -> None:
        """PUT a file, or what it has from an offset on."""
        headers = {"Content-Length": str(size), "Content-Digest": digest}
        query = {"offset": offset} if offset else {}
        with self._answering():
            response = self._http.put(
                f"{_path(block)}/files/{quote(name)}",
                content=content,
                headers=headers,
                params=query,
            )
        _require_success(response, block)

    def offered(self, block: Block, drop: Drop) -> str | None:
        """POST what shall be put into the bucket. Returns the address there, or None."""
        with self._answering():
            response = self._http.post(f"{_path(block)}/drops", **_json(drop))
        if response.status_code in (httpx.codes.NO_CONTENT, httpx.codes.NOT_FOUND):
            return None  # a service of an earlier version knows of none
        _require_success(response, block)
        return answer_of(DropAt, response.content).address

    def taken(self, block: Block, drop: Drop) -> bool:
        """POST what was put. Returns whether the service found it, with the right bytes."""
        patient = httpx.Timeout(_LONGEST_TAKING, connect=5.0)
        with self._answering():
            response = self._http.post(
                f"{_path(block)}/drops/taken", **_json(drop), timeout=patient
            )
        refused = response.status_code == httpx.codes.UNPROCESSABLE_ENTITY
        if refused and not _problem_of(response)[0].endswith(_REFUSED):
            return False
        _require_success(response, block)
        return True

    def remove(self, block: Block, name: str) -> None:
        """DELETE a file."""
        with self._answering():
            response = self._http.delete(f"{_path(block)}/files/{quote(name)}")
        _require_success(response, block)

    @contextmanager
    def _answering(self) -> Iterator[None]:
        try:
            yield
        except httpx.RequestError as error:
            reason = f"cannot be reached at {self.url} ({str(error) or type(error).__name__})"
            raise Unavailable(reason) from error


def is_private(url: httpx.URL) -> bool:
    """Whether nobody on the way reads what is sent to an address."""
    return url.scheme == "https" or (url.scheme == "http" and is_local(url))


def is_local(url: httpx.URL) -> bool:
    """Whether an address is this machine's own."""
    return url.host in _LOOPBACK


def key_in(path: Path) -> str:
    """Return the key that is the only line of a file; Refused if there is none."""
    with path.open(encoding="utf-8", errors="replace") as file:
        text = file.read(_LARGEST_KEY).strip()
    if not text.startswith("jp_") or not text.isascii() or len(text.split()) != 1:
        raise Refused(f"{path} holds no key; `jointplay key new --scope worker` makes one")
    return text


def answer_of(kind: type[Answer], content: bytes) -> Answer:
    """Return the document that a service answered with; Unavailable if it is no such one."""
    try:
        return kind.model_validate_json(content)
    except ValidationError as error:
        raise Unavailable(f"gives an answer that is none of a service: {error}") from error


def _path(block: Block) -> str:
    return f"/v1/worker/blocks/{block.id}/{block.attempt}"


def _json(document: Document) -> dict[str, Any]:
    content = document.model_dump_json(exclude_none=True).encode()  # none: as if it was not there
    return {"content": content, "headers": {"Content-Type": "application/json"}}


def _require_success(response: httpx.Response, block: Block | None) -> None:
    if response.is_success:
        found = response.headers.get("Content-Type", "").partition(";")[0]
        if response.status_code != httpx.codes.NO_CONTENT and found not in _OWN:
            raise Unavailable(f"gives an answer that is none of a service: {found or 'no type'}")
        return
    kind, detail = _problem_of(response)
    if block is not None and kind.endswith("/not-held"):
        raise Fenced(block.id, block.attempt)
    if block is not None and kind.endswith(_REFUSED):
        raise ResultsRefused(block, detail)
    if response.status_code == _FULL:
        raise Unavailable("has no room for results", full=True)
    # while a block is held, what is no problem of a service is of a proxy that has lost its service
    stray = block is not None and not kind
    if stray or response.status_code in _MAY_PASS or response.is_server_error:
        raise Unavailable(f"refuses for now: {detail}")
    raise Refused(f"the service does not take this worker: {detail}")


def _problem_of(response: httpx.Response) -> tuple[str, str]:
    """Return type and detail of a problem; no type if the answer is no service's."""
    try:
        problem = response.json()
        return str(problem["type"]), str(problem["detail"])
    except (ValueError, KeyError, TypeError):
        return "", f"it answers with status {response.status_code}"
