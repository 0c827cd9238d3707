"""`python -m jointplay.service.checking FD`: checks documents that it receives, until it is idle.

What is refused is answered as the problem that clients read, which is short however much is wrong.
"""

import logging
import sys
from contextlib import suppress
from multiprocessing.connection import Connection

from jointplay.records.strict_json import parse
from jointplay.service.checking import Check, Checked
from jointplay.service.problems import RequestRefused
from jointplay.service.problems.handlers import refusal
from jointplay.storage.settings import Settings

_IDLE = 60.0  # s after which memory is given back
_log = logging.getLogger(__name__)


def _answer(what: Check, body: bytes, path: str, settings: Settings) -> Checked | RequestRefused:
    try:
        return what(parse(body), path, settings)
    except Exception as error:  # noqa: BLE001 - as the API itself does with any
        refused = refusal(error)
        if refused.kind.status >= 500:
            _log.exception("a document of %d bytes could not be checked", len(body))
        return refused


def main() -> None:
    """Answer until nobody asks any more."""
    with Connection(int(sys.argv[1])) as asking, suppress(EOFError, BrokenPipeError):
        while asking.poll(_IDLE):
            asking.send(_answer(*asking.recv()))


if __name__ == "__main__":
    main()
