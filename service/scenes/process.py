"""A process that looks at scenes, so that no scene holds up the requests of others."""

from typing import Any

from jointplay.service.answering import AnsweringProcess, refusing
from jointplay.service.problems import RequestRefused, kinds


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
        patience = self._process.patience
        too_slow = f"Looking at this scene takes more than {patience:g} s; use fewer bodies."
        with refusing(
            "Many scenes are being looked at; ask again in a moment.",
            RequestRefused(kinds.LIMIT_EXCEEDED, too_slow),
            "The scene could not be looked at.",
        ):
            answer = self._process.answer(question)
        if isinstance(answer, RequestRefused):
            raise answer
        return answer

    def close(self) -> None:
        """End the process."""
        self._process.close()
