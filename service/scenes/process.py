"""A process that looks at scenes, so that no scene holds up the requests of others."""

from typing import Any

from jointplay.service.answering import AnsweringProcess, Busy, NoAnswer, TooSlow
from jointplay.service.problems import RequestRefused, kinds
from jointplay.service.problems import unavailable as put_off


class SceneProcess:
    """Asks a process about scenes, which is kept while somebody asks.

    Parameters
    ----------
    module
        Its program; what it refuses it answers with `RequestRefused`.
    patience
        Seconds for one answer.
    """

    def __init__(self, module: str, patience: float) -> None:
        self._process = AnsweringProcess(module, patience)

    def ask(self, *question: object) -> Any:
        """Return the answer to a question; RequestRefused if there is none."""
        try:
            answer = self._process.answer(question)
        except Busy:
            raise put_off("Many scenes are being looked at; ask again in a moment.", 2) from None
        except TooSlow:
            patience = self._process.patience
            sentence = f"Looking at this scene takes more than {patience:g} s; use fewer bodies."
            raise RequestRefused(kinds.LIMIT_EXCEEDED, sentence) from None
        except NoAnswer:
            raise put_off("The scene could not be looked at.", 5) from None
        if isinstance(answer, RequestRefused):
            raise answer
        return answer

    def close(self) -> None:
        """End the process."""
        self._process.close()
