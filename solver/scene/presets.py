"""The preset scenes that come with the package."""

import hashlib
import json
from functools import cache
from importlib import resources
from typing import Any

from jointplay.records.failure import InvalidInput
from jointplay.records.suggestions import unknown


@cache
def _documents() -> dict[str, str]:
    folder = resources.files("jointplay.scenes")
    texts = [f.read_text("utf-8") for f in folder.iterdir() if f.name.endswith(".json")]
    return dict(sorted((json.loads(text)["name"], text) for text in texts))


def names() -> list[str]:
    """Return the names of all presets, sorted."""
    return list(_documents())


def document(name: str, pointer: str = "/scene/preset") -> dict[str, Any]:
    """Return a preset's scene document.

    Raises
    ------
    InvalidInput
        There is no preset of that name.
    """
    if name not in _documents():
        raise InvalidInput.at(pointer, unknown("preset", name, names()))
    loaded: dict[str, Any] = json.loads(_documents()[name])
    return loaded


@cache
def digest(name: str) -> str:
    """Return the SHA-256 of a preset's scene document."""
    return hashlib.sha256(_documents()[name].encode()).hexdigest()
