"""The solver's version: the package's and a digest of the sources that make the numbers."""

import hashlib
from functools import cache
from importlib import metadata
from pathlib import Path

from jointplay import records


@cache
def source_digest(folder: Path) -> str:
    """Return the first 48 bits of the SHA-256 of all Python sources in a folder, as hexadecimal."""
    digest = hashlib.sha256()
    for path in sorted(folder.rglob("*.py")):
        digest.update(path.relative_to(folder).as_posix().encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()[:12]


_SOURCES = (Path(__file__).parent, Path(records.__file__).parent)
"""Sources of the solver, and of the vocabulary, which orders points and tells attractors apart."""
_DIGEST = hashlib.sha256("".join(map(source_digest, _SOURCES)).encode()).hexdigest()[:12]
SOLVER_VERSION = f"{metadata.version('jointplay')}+{_DIGEST}"
