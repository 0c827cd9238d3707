"""`python -m jointplay.service.checking FD`: checks documents that it receives, until idle."""

from functools import lru_cache
from typing import Any

from jointplay.records.strict_json import parse
from jointplay.service.checking import Check
from jointplay.service.questions import answer_or_refuse
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.settings import Settings

_IDLE = 60.0  # s

_catalogue_at = lru_cache(maxsize=1)(Catalogue)
"""The catalogue at an address, which is opened by the first check that asks it something."""


def check(what: Check[Any], body: bytes, settings: Settings) -> object:
    """Return what a check finds of a document."""
    return what(parse(body), settings, _catalogue_at(settings.catalogue_url))


if __name__ == "__main__":
    answer_or_refuse(check, _IDLE)
