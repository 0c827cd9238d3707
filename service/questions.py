"""The loop of the service's own programs: what the API would refuse they answer with a refusal."""

import logging
from collections.abc import Callable
from typing import Any

from jointplay.service.problems import kinds
from jointplay.service.problems.refusals import refusal
from jointplay.worker.answering import answer_questions

_log = logging.getLogger(__name__)


def answer_or_refuse(answer: Callable[..., object], idle: float) -> None:
    """Answer questions, which are arguments of `answer`, until there is none for `idle` seconds.

    What it raises is answered as the problem that clients read, which is short however much is
    wrong.
    """

    def answered(question: tuple[Any, ...]) -> object:
        try:
            return answer(*question)
        except Exception as error:  # noqa: BLE001 - as the API itself does with any
            refused = refusal(error)
            if refused.kind is kinds.INTERNAL:
                _log.exception("%s failed", answer.__qualname__)
            return refused

    answer_questions(answered, idle)
