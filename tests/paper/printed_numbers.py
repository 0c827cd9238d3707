"""Places of the numbers that the publication prints."""

from collections.abc import Iterator
from typing import Any

from jointplay.paper import reported

KINDS = ("ideal", "response_peaks", "adams_comparison", "phase_ranges", "test_bed")
"""Parts of the document that hold measured or computed numbers."""


def pointers() -> set[str]:
    """Return the JSON pointers of all printed numbers; settings are not among them."""
    document = reported.document()
    return {pointer for kind in KINDS for pointer in _numbers(document[kind], f"/{kind}")}


def _numbers(value: Any, pointer: str) -> Iterator[str]:
    if isinstance(value, dict):
        for key, inner in value.items():
            if key not in (*reported.SETTINGS, "rpm"):
                yield from _numbers(inner, f"{pointer}/{key}")
    elif isinstance(value, list):
        for index, inner in enumerate(value):
            yield from _numbers(inner, f"{pointer}/{index}")
    elif isinstance(value, int | float):
        yield pointer
