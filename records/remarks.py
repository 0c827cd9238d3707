"""Remarks in documents: fields for people and editors, which mean nothing to the program."""

from collections.abc import Mapping
from typing import Any, Final

REMARKS: Final = ("$schema", "_comment")
"""Fields that any object of a document may have: where its schema is, and what its author says."""


def without_remarks(document: Any) -> Any:
    """Return a document of JSON without its remarks."""
    if isinstance(document, Mapping):
        return {
            name: without_remarks(value) for name, value in document.items() if name not in REMARKS
        }
    if isinstance(document, list) and any(isinstance(one, dict | list) for one in document):
        return [without_remarks(one) for one in document]
    return document
