"""Address of a catalogue in a file: ``sqlite:///`` and its path, whatever the path has in it."""

from pathlib import Path
from typing import Final
from urllib.parse import unquote

_SCHEME: Final = "sqlite:///"


def sqlite_address(file: Path) -> str:
    """Return the address of a file; ``%`` and ``?``, which mean something there, are escaped."""
    return _SCHEME + str(file).replace("%", "%25").replace("?", "%3F")


def sqlite_file(address: str) -> Path | None:
    """Return the file at an address; None if the catalogue is elsewhere, or no file is named."""
    path = address.removeprefix(_SCHEME).partition("?")[0]
    return Path(unquote(path)) if path and address.startswith(_SCHEME) else None
