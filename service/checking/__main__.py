"""`python -m jointplay.service.checking FD`: checks documents that it receives, until it is idle.

What is refused is answered as the problem that clients read, which is short however much is wrong.
"""

import logging
from functools import lru_cache
from typing import Any

from jointplay.records.strict_json import parse
from jointplay.service.checking import Check
from jointplay.service.problems import kinds
from jointplay.service.problems.refusals import refusal
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.settings import Settings
from jointplay.worker.answering import answer_questions

_IDLE = 60.0  # s
_log = logging.getLogger(__name__)

_catalogue_at = lru_cache(maxsize=1)(Catalogue)
"""The catalogue at an address, which is opened by the first check that asks it something."""


def _answer(what: Check[Any], body: bytes, settings: Settings) -> object:
    try:
        return what(parse(body), settings, _catalogue_at(settings.catalogue_url))
    except Exception as error:  # noqa: BLE001 - as the API itself does with any
        refused = refusal(error)
        if refused.kind is kinds.INTERNAL:
            _log.exception("a document of %d bytes could not be checked", len(body))
        return refused


if __name__ == "__main__":
    answer_questions(lambda question: _answer(*question), _IDLE)
