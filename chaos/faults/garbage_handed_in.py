"""A worker that joined and says that it has computed what it has not."""

from base64 import b64encode
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from hashlib import sha256
from importlib.metadata import version
from random import Random
from typing import Final

import httpx

from jointplay.chaos.faults.fault import Fault
from jointplay.chaos.installation import Installation
from jointplay.worker.joined.protocol import ClaimRequest
from jointplay.worker.own_solver import own_solver

_WAIT: Final = 5.0  # s, for a block
_PATIENCE: Final = 20.0  # s, for an answer


class GarbageHandedIn(Fault):
    """A block is claimed, and said to be done with nothing or garbage in place of its results."""

    @contextmanager
    def strike(self, installation: Installation, drawn: Random) -> Iterator[None]:
        """Claim the next block and finish it, or leave it to its lease."""
        own = own_solver()
        asked = ClaimRequest(
            program=version("jointplay"),
            worker="liar:1:1:liar",
            version=own.version,
            processor=own.processor,
            wait=_WAIT,
        )
        head = {"Content-Type": "application/json"}
        with (
            suppress(httpx.TransportError),
            httpx.Client(base_url=installation.url, trust_env=False, timeout=_PATIENCE) as http,
        ):
            path = "/v1/worker/claims"
            answer = http.post(path, content=asked.model_dump_json(), headers=head)
            if answer.status_code == httpx.codes.OK:
                _lie(http, answer.json()["claim"]["block"], drawn)
        yield


def _lie(http: httpx.Client, block: dict[str, object], drawn: Random) -> None:
    path = f"/v1/worker/blocks/{block['id']}/{block['attempt']}"
    if drawn.random() < 0.5:
        name = drawn.choice((f"sealed/{block['attempt']}", "sealed/study"))
        content = drawn.randbytes(1000)
        told = f"sha-256=:{b64encode(sha256(content).digest()).decode()}:"
        http.put(f"{path}/files/{name}", content=content, headers={"Content-Digest": told})
    http.post(f"{path}/finish", json={"outcome": "done"})
