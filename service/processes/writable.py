"""Files of a data folder that a service cannot write, as those that another user's left."""

import os
import shlex
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
    if path is None:
        return
    if path.stat().st_uid == os.geteuid():
        raise WrongSetting(f"{path} cannot be written: its mode or its disk is read-only")
    raise WrongSetting(
        f"{path}, of user {_owner(path)}, cannot be written, as if another user had run a service"
        f" here; give the folder to this one: chown -R {os.geteuid()} {shlex.quote(str(data))}"
    )


def _refusing(data: Path) -> Iterator[Path]:
    """Yield what cannot be written, folders before what is in them."""
    for patterns, mode in ((_FOLDERS, os.W_OK | os.X_OK), (_FILES, os.W_OK)):
        for pattern in patterns:
            for path in sorted(data.glob(pattern)):
                if not os.access(path, mode, effective_ids=_EFFECTIVE) and path.exists():
                    yield path


def _owner(path: Path) -> str:
    try:
        return path.owner()
    except KeyError:
        return str(path.stat().st_uid)
