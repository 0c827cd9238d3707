"""A seeded mix of jobs of every kind, each of some seconds of computing."""

import json
import random
from pathlib import Path
from typing import Any, Final

Document = dict[str, Any]
_FILE = Path(__file__).with_name("jobs.json")
_FACTORS: Final = (0.8, 1.25)


def jobs_of(seed: int) -> list[Document]:
    """Return one job of each kind at least, parameters multiplied by factors drawn from a seed.

    They are few, so that each needs to be computed only once without disturbance.
    """
    drawn = random.Random(seed)  # noqa: S311 - repeatable on purpose
    mix: list[Document] = json.loads(_FILE.read_text())
    for job in mix:
        parameters = job["scene"]["parameters"]
        for name, value in parameters.items():
            parameters[name] = value * drawn.uniform(*_FACTORS)
    return mix
