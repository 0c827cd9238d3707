"""The process that computes the beginning of jobs, kept warm: `jointplay.worker.probe`."""

from typing import Any

from jointplay.records.failure import InvalidInput, Problem
from jointplay.service.answering import AnsweringProcess, refusing
from jointplay.service.problems import unavailable

_PATIENCE = 90.0  # s; compiling the kernel of a new mechanism takes some 20 of them


class Prober:
    """Asks the probing process."""

    def __init__(self) -> None:
        self._process = AnsweringProcess("jointplay.worker.probe", _PATIENCE)

    def cost_of(self, job: dict[str, Any], *, on_devices: bool = False) -> dict[str, Any]:
        """Return what an admitted job costs, as `worker.probe.Cost` has it.

        Raises
        ------
        InvalidInput
            The solver cannot compute it after all.
        RequestRefused
            503: too many are waiting, or the process does not answer.
        """
        too_slow = (
            f"No estimate was made within {_PATIENCE:g} s, most often because the equations take"
            " longer to compile; it is made fast once a job of this scene has run."
        )
        with refusing(
            "Many estimates are being made; ask again in a moment.",
            unavailable(too_slow, 30),
            "The beginning of the job could not be computed.",
        ):
            answer = self._process.answer({"job": job, "on_devices": on_devices})
        if "refused" in answer:
            raise InvalidInput([Problem("", str(answer["refused"]))])
        return dict(answer)

    def close(self) -> None:
        """End the process."""
        self._process.close()
