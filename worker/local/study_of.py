"""The study of an admitted job, in each process that computes a part of it."""

import json
from functools import lru_cache
from typing import TYPE_CHECKING, cast

if TYPE_CHECKING:
    from jointplay.solver.kinds import Study


@lru_cache(maxsize=1)
def study_of(job: str) -> "Study":
    """Return the study of a job's document, once parsed in each process."""
    from jointplay.solver.kinds import parse

    return cast("Study", parse(json.loads(job)))
