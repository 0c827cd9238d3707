"""A journal of a search, so that one that was interrupted goes on where it was."""

import json
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Any, Generic, TypeVar

import numpy as np

V = TypeVar("V")


class Journal(Generic[V]):
    """A judge that remembers: verdicts of jobs in order, each written down as it is known.

    A search is the same for the same seed, so that the jobs it comes to are those it came to.
    """

    def __init__(self, path: Path, judge: Callable[[dict[str, Any]], V], kind: type[V]) -> None:
        """Read what a journal has; `kind` is the dataclass of its verdicts."""
        self._path, self._judge, self._kind = path, judge, kind
        written = path.read_text().splitlines(keepends=True) if path.exists() else []
        whole = [line for line in written if line.endswith("\n")]
        path.write_text("".join(whole))  # without a line that was cut off
        self._known = iter([json.loads(line) for line in whole])

    def __call__(self, job: dict[str, Any]) -> V:
        """Return the verdict of the next job; ValueError: the journal is of another search."""
        found = next(self._known, None)
        if found is None:
            verdict = self._judge(job)
            fields = {name: _plain(value) for name, value in asdict(verdict).items()}  # type: ignore[call-overload]
            with self._path.open("a") as journal:
                journal.write(json.dumps({"job": job, "verdict": fields}) + "\n")
            return verdict
        if found["job"] != job:
            raise ValueError(f"{self._path} is the journal of another search")
        fields = found["verdict"]
        return self._kind(
            **{n: np.array(x) if isinstance(x, list) else x for n, x in fields.items()}
        )


def _plain(value: Any) -> Any:
    return value.tolist() if isinstance(value, np.ndarray | np.generic) else value
