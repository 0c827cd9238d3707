"""The process that computes windows of trajectories, kept warm: `jointplay.worker.windows`."""

from jointplay.service.answering import AnsweringProcess, refusing
from jointplay.service.problems import unavailable
from jointplay.storage.results.reader import ResultReader
from jointplay.worker.windows.question import Answer, Question
from jointplay.worker.windows.trajectory import Trajectory

_PATIENCE = 240.0  # s; what is not compiled yet takes some 20 of them, and 60 on a busy machine


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
            unavailable("The window took too long to compute; a shorter one is faster.", 30),
            "The window could not be computed.",
        ):
            found = self._process.answer(question)
        assert isinstance(found, Answer)  # noqa: S101  (the process is our own)
        return found
