"""The process that computes windows of trajectories, kept warm: `jointplay.worker.windows`."""

from jointplay.service.answering import AnsweringProcess, refusing
from jointplay.service.problems import RequestRefused
from jointplay.service.problems.kinds import UNAVAILABLE
from jointplay.storage.results.reader import ResultReader
from jointplay.worker.windows.question import Answer, Question
from jointplay.worker.windows.trajectory import Trajectory

_PATIENCE = 240.0  # s; what is not compiled yet takes some 20 of them, and 60 on a busy machine


class TooLong(RequestRefused):
    """A window takes more computing than the patience, whatever else the service has to do."""


class WindowProcess:
    """Asks the process for values and extremes between samples."""

    def __init__(self) -> None:
        self._process = AnsweringProcess("jointplay.worker.windows", _PATIENCE)

    def of(self, reader: ResultReader) -> Trajectory:
        """Return a run's trajectory, which asks this process."""
        return Trajectory(reader, self._answer)

    def close(self) -> None:
        """End the process."""
        self._process.close()

    def _answer(self, question: Question) -> Answer:
        with refusing(
            "Many windows are being computed; ask again in a moment.",
            TooLong(
                UNAVAILABLE,
                "The window took too long to compute; a shorter one is faster.",
                headers={"Retry-After": "30"},
            ),
            "The window could not be computed.",
        ):
            found = self._process.answer(question)
        assert isinstance(found, Answer)  # noqa: S101  (the process is our own)
        return found
