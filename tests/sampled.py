"""Cases of a large family of tests: a sample in `make test`, the others in `make test-long`."""

import random
from collections.abc import Iterable
from typing import Any

import pytest


def sampled(cases: Iterable[Any], count: int, ids: Iterable[str] | None = None) -> list[Any]:
    """Return all cases as parameters; all but `count`, drawn with a fixed seed, take long."""
    cases = list(cases)
    names = [str(case) for case in cases] if ids is None else list(ids)
    kept = random.Random(len(cases)).sample(range(len(cases)), count)
    return [
        pytest.param(case, id=name, marks=[] if index in kept else [pytest.mark.long])
        for index, (case, name) in enumerate(zip(cases, names, strict=True))
    ]
