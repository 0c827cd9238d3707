"""The solver's version: the package's and a digest of the sources that make the numbers."""

import hashlib
from functools import cache
from importlib import metadata
from pathlib import Path


@cache
def source_digest(folder: Path) -> str:
    """Return the first 48 bits of the SHA-256 of all Python sources in a folder, as hexadecimal."""
    digest = hashlib.sha256()
    for path in sorted(folder.rglob("*.py")):
        digest.update(path.relative_to(folder).as_posix().encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()[:12]


SOLVER_VERSION = f"{metadata.version('jointplay')}+{source_digest(Path(__file__).parent)}"
