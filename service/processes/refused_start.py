"""Why the HTTP process cannot start, and what helps, in place of a traceback."""

import sys
from typing import Final

from starlette.types import ASGIApp as Application
from starlette.types import Message, Receive, Scope, Send

from jointplay.storage.catalogue.errors import Broken, Unavailable, WrongRevision
from jointplay.storage.installation import OtherFiles
from jointplay.storage.object_stores.fitness import Unfit

_FAILED: Final = "lifespan.startup.failed"
_REMEDIES: Final[tuple[tuple[type[Exception], str], ...]] = (
    (
        Broken,
        ". Put a backup of the catalogue back (docs/operating.md), or begin with another folder:"
        " JOINTPLAY_DATA, or --data",
    ),
    (Unavailable, ". Does its database run, and is it the one of JOINTPLAY_CATALOGUE_URL?"),
    (WrongRevision, ""),
    (OtherFiles, ""),
    (Unfit, ". Results need another store: JOINTPLAY_RESULTS_URL"),
    (ConnectionError, ". Does the store run, and is it the one of JOINTPLAY_RESULTS_URL?"),
    (OSError, ""),
)


class RefusedStart:
    """Tells why an application that is watched did not start, where that is known."""

    def __init__(self) -> None:
        self.sentence: str | None = None
        """Why it did not; none if it did, or nobody foresaw why."""

    def watched(self, application: Application) -> Application:
        """Return an application that serves as this one does, and writes no such traceback."""

        async def serving(scope: Scope, receive: Receive, send: Send) -> None:
            async def without_traceback(message: Message) -> None:
                error = sys.exception()
                if message["type"] == _FAILED and error is not None:
                    self.sentence = reason(error)
                    message = message if self.sentence is None else {"type": _FAILED}
                await send(message)

            starts = scope["type"] == "lifespan"
            await application(scope, receive, without_traceback if starts else send)

        return serving


def reason(error: BaseException) -> str | None:
    """Return why a service cannot start, and what helps; none of what nobody foresaw."""
    said = ": ".join((str(error), *getattr(error, "__notes__", ())))
    if isinstance(error, Unavailable) and error.full:
        return f"{said}. Make room there"
    if isinstance(error, OSError) and error.filename is not None:
        said = f"{error.filename}: {error.strerror}"
    remedies = (remedy for kind, remedy in _REMEDIES if isinstance(error, kind))
    return next((said + remedy for remedy in remedies), None)
