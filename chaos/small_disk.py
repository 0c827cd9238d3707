"""A small disk of a campaign's own, which can be filled without harm to others."""

import subprocess
from pathlib import Path

_SMALLEST, _GROWTH = 2**28, 2**20
"""Bytes: of a short campaign's disk, and of what each second of a longer one computes."""


def room_for(duration: float) -> int:
    """Return the bytes of a disk that has room for what a campaign of so many seconds computes."""
    return max(_SMALLEST, int(_GROWTH * duration))


def on_small_disk(folder: Path, size: int, command: list[str]) -> list[str]:
    """Return the command that sees a file system of `size` bytes at a folder, which is made.

    It needs root, or a system that lets users make name spaces; the disk goes with the command.
    Where neither is given, the command itself is returned.
    """
    alone = ["unshare", "--map-root-user", "--mount", "--"]
    mounting = f"mount -t tmpfs -o size={size} jointplay-chaos"
    inside = [*alone, "sh", "-ec", f'{mounting} "$0"; exec "$@"', str(folder)]
    folder.mkdir()
    try:
        subprocess.run([*inside, "true"], check=True, capture_output=True)  # noqa: S603
    except (OSError, subprocess.CalledProcessError):
        return command
    return [*inside, *command]
