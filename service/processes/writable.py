"""What an earlier service of another user left in a data folder, which this one cannot write."""

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Final

from jointplay.service.processes.child import WrongSetting

_FILES: Final = ("serve.lock", "catalogue.sqlite", "catalogue.sqlite-*", "logs/*.log")
_FOLDERS: Final = ("broker", "logs", "running", "results", "running/??", "results/??")
_EFFECTIVE: Final = os.access in os.supports_effective_ids


def require_writable(data: Path) -> None:
    """Raise WrongSetting, which names a file or folder, if a service could not write there.

    Parameters
    ----------
    data
        The data folder, which need not be there.
    """
    path = next(_refusing(data), None)
    if path is not None:
        raise WrongSetting(
            f"{path}, of user {_owner(path)}, cannot be written, as if another user had run a"
            f" service here; give the folder to this one: chown -R {os.geteuid()} {data}"
        )


def _refusing(data: Path) -> Iterator[Path]:
    """Yield what cannot be written, folders before what is in them."""
    for patterns, mode in ((_FOLDERS, os.W_OK | os.X_OK), (_FILES, os.W_OK)):
        for pattern in patterns:
            for path in sorted(data.glob(pattern)):
                if not os.access(path, mode, effective_ids=_EFFECTIVE):
                    yield path


def _owner(path: Path) -> str:
    try:
        return path.owner()
    except KeyError:
        return str(path.stat().st_uid)
