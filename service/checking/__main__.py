"""`python -m jointplay.service.checking FD`: checks documents that it receives, until it is idle.

What is refused is answered as the problem that clients read, which is short however much is wrong.
"""

import logging

from jointplay.records.strict_json import parse
from jointplay.service.checking import Check, Checked
from jointplay.service.problems import RequestRefused
from jointplay.service.problems.handlers import refusal
from jointplay.storage.settings import Settings
from jointplay.worker.answering import answer_questions

_IDLE = 60.0  # s
_log = logging.getLogger(__name__)


def _answer(what: Check, body: bytes, path: str, settings: Settings) -> Checked | RequestRefused:
    try:
        return what(parse(body), path, settings)
    except Exception as error:  # noqa: BLE001 - as the API itself does with any
        refused = refusal(error)
        if refused.kind.status >= 500:
            _log.exception("a document of %d bytes could not be checked", len(body))
        return refused


if __name__ == "__main__":
    answer_questions(lambda question: _answer(*question), _IDLE)
