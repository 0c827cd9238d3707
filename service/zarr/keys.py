"""Which addresses below a store can exist at all."""

import re
from typing import Final

INTERNAL: Final = "pyramid/"
"""Group of what the service reads itself and no client is shown."""

_KEY: Final = re.compile(
    r"(?:(?!\.)[A-Za-z0-9_.-]{1,96}/){0,4}(?:zarr\.json|c(?:/\d{1,9}){0,4})", re.ASCII
)


def is_key(text: str) -> bool:
    """Tell whether a text can name a metadata document or a chunk of a store.

    Asked before any path is touched: nothing else can leave the store's folder, name what is
    hidden in it, or be too long for a file system.
    """
    return _KEY.fullmatch(text) is not None and not text.startswith(INTERNAL)
