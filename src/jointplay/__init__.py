"""The user's package: client, figures, command line.

>>> import jointplay
>>> job = jointplay.run("pendulum", duration=1.0)  # doctest: +SKIP
>>> client = jointplay.Client("http://127.0.0.1:8000")  # doctest: +SKIP
"""

from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    __version__: str
    from jointplay.client import AsyncClient, Client, Job
    from jointplay.local import load, resume, run

if Path(__file__).with_name("solver").is_file():
    raise ImportError(
        "This copy of jointplay has text files in place of the symbolic links in src/jointplay."
        " Clone it again with `git clone -c core.symlinks=true` (on Windows in Developer Mode), or"
        " install a wheel."
    )

__all__ = ["AsyncClient", "Client", "Job", "load", "resume", "run"]


def __getattr__(name: str) -> Any:
    """Load what is asked for: the command line's parser needs none of it."""
    from importlib import import_module

    if name in ("AsyncClient", "Client", "Job"):
        return getattr(import_module("jointplay.client"), name)
    if name in ("load", "resume", "run"):
        return getattr(import_module("jointplay.local"), name)
    if name == "__version__":
        from importlib.metadata import version

        return version("jointplay")
    if name in ("client", "figures", "jobs"):
        return import_module(f"jointplay.{name}")
    raise AttributeError(f"module 'jointplay' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__, "__version__", "client", "figures", "jobs"})
