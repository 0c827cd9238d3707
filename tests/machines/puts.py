"""Ways by which the files of workers that joined have come into the bucket, as the logs tell."""

import json
from collections import Counter
from collections.abc import Iterable
from pathlib import Path

_OF_BLOCK = "/v1/worker/blocks/{block}/{attempt}"
_WAYS = {
    ("POST", f"{_OF_BLOCK}/drops", 200): "addresses signed",
    ("POST", f"{_OF_BLOCK}/drops/taken", 204): "put there and taken",
    ("POST", f"{_OF_BLOCK}/drops/taken", 422): "put there and not right",
    ("PUT", f"{_OF_BLOCK}/files/{{name:path}}", 204): "through the service",
}
_FALLBACK = "files go through the service"


def ways(apis: Iterable[Path], workers: Iterable[Path]) -> dict[str, int]:
    """Count requests in logs of APIs, and how often logs of workers say that the bucket failed."""
    found = Counter(dict.fromkeys(_WAYS.values(), 0))
    for log in apis:
        for line in log.read_text(errors="replace").splitlines():
            if '"route"' in line:
                told = json.loads(line)
                found[_WAYS.get((told["method"], told["route"], told["status"]), "")] += 1
    del found[""]
    failed = sum(log.read_text(errors="replace").count(_FALLBACK) for log in workers)
    return dict(found) | {"bucket failed": failed}
