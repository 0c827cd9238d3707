"""Names of what `storage.catalogue.tally` counts."""

from typing import Final

OUTCOMES: Final = ("done", "failed", "cancelled", "released", "put-off", "lost", "refused")
"""Ends of attempts."""
PUBLISHED: Final = "published"
PUBLISHING: Final = "seconds of publishing"
COMPILING: Final = "seconds of compiling"
ON_DEVICES: Final = "points on devices"
OF_WORKERS: Final = (PUBLISHED, PUBLISHING, COMPILING, ON_DEVICES)
"""Counters that workers tell themselves."""


def of_outcome(outcome: str) -> str:
    """Name the counter of attempts that ended so; `storage.catalogue.functions` has it, too."""
    return f"attempts {outcome}"
