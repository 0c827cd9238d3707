"""Checking what is submitted: short documents at once, all others in processes of their own.

What is long, or has many bodies, would hold up every other request, and the memory that it takes
would never be given back. Those processes can be ended, and end by themselves when idle.
"""

import json
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass

from jointplay.records.failure import LimitExceeded
from jointplay.records.strict_json import parse
from jointplay.service.answering import AnsweringProcess, Busy, NoAnswer, TooSlow
from jointplay.service.batches.admission import admit_batch
from jointplay.service.idempotency import fingerprint
from jointplay.service.jobs.submission import checked
from jointplay.service.problems import RequestRefused, unavailable
from jointplay.solver.kernels.record.equations import SURELY_SHORT
from jointplay.storage.catalogue.records import NewJob
from jointplay.storage.settings import Settings

SHORT = 32 * 1024
"""Bytes that are parsed within a millisecond."""
_MODULE = "jointplay.service.checking"


class PackedJobs(Collection[NewJob]):
    """The jobs of a batch, each unpacked when its turn comes: 10 000 would take 60 MB."""

    def __init__(self, jobs: Collection[NewJob]) -> None:
        self._packed = [json.dumps(vars(job)) for job in jobs]

    def __len__(self) -> int:
        return len(self._packed)

    def __iter__(self) -> Iterator[NewJob]:
        for packed in self._packed:
            fields = json.loads(packed)
            blocks = tuple((first, count) for first, count in fields["blocks"])
            yield NewJob(**fields | {"blocks": blocks})

    def __contains__(self, job: object) -> bool:
        return any(job == one for one in self)


@dataclass(frozen=True)
class Checked:
    """Jobs that can be computed, of one document."""

    jobs: Collection[NewJob]
    fingerprint: str
    """Digest of the document and where it was sent; empty if nobody asked for it."""
    reuse: bool = False
    """Whether an identical job will do."""
    label: str = ""
    """Name of the batch."""


Check = Callable[[object, str, Settings], Checked]
"""Takes a document, the path that it was sent to (empty: no fingerprint is wanted), settings."""


def check_job(document: object, path: str, settings: Settings) -> Checked:
    """Check one job; raises what `checked` does."""
    new, reuse = checked(document, settings)
    return Checked((new,), fingerprint(path, document), reuse=reuse)


def check_batch(document: object, path: str, settings: Settings) -> Checked:
    """Check many jobs; raises what `admit_batch` does."""
    jobs, label = admit_batch(document, settings)
    return Checked(PackedJobs(jobs), fingerprint(path, document), label=label)


class Checker:
    """Checks documents where they are best checked.

    A batch of 10 000 jobs takes half a minute, which single jobs do not wait for.

    Parameters
    ----------
    patience
        Seconds for one job; batches may take ten times as long.
    """

    def __init__(self, settings: Settings, patience: float = 60.0) -> None:
        self._settings = settings
        self._processes: dict[Check, AnsweringProcess] = {
            check_job: AnsweringProcess(_MODULE, patience),
            check_batch: AnsweringProcess(_MODULE, 10 * patience),
        }

    def check(self, what: Check, body: bytes, path: str = "") -> Checked:
        """Return what a check finds of a document.

        Raises
        ------
        MalformedJson, InvalidInput, LimitExceeded, RequestRefused
            It is wrong, takes too long to check, or too many are being checked (503).
        """
        if len(body) <= SHORT:
            document = parse(body)
            if not _has_many_bodies(document):
                return what(document, path, self._settings)
        process = self._processes[what]
        try:
            answer: Checked | RequestRefused = process.answer((what, body, path, self._settings))
        except Busy:
            sentence = "Many large documents are being checked; send it again in a moment."
            raise unavailable(sentence, 2) from None
        except TooSlow:
            sentence = f"Checking this takes more than {process.patience:g} s; send a smaller one."
            raise LimitExceeded.at("", sentence) from None
        except NoAnswer:
            raise unavailable("The document could not be checked.", 5) from None
        if isinstance(answer, RequestRefused):
            raise answer
        return answer

    def close(self) -> None:
        """End the processes."""
        for process in self._processes.values():
            process.close()


def _has_many_bodies(document: object) -> bool:
    """Whether equations must be recorded to see whether they are too long."""
    if not isinstance(document, dict):
        return False
    jobs = document.get("jobs")
    if isinstance(jobs, list):
        return any(_has_many_bodies(job) for job in jobs)
    scene = document.get("scene")
    bodies = scene.get("bodies") if isinstance(scene, dict) else None
    return isinstance(bodies, dict) and len(bodies) > SURELY_SHORT
