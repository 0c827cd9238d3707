"""A user of the service: submits, repeats what was not answered, cancels some, looks at all."""

import random
import threading
from collections.abc import Sequence
from typing import Any, Final

import httpx

from jointplay.chaos.history import History, Submission
from jointplay.chaos.jobs import Document
from jointplay.chaos.service import Service

_REFUSALS: Final = {503, 507}
"""Answers of a service that cannot do it now; with them it says when to ask again."""
_ONE_CANCELLED_OF = 9
_PAUSE = 0.25  # s, between two rounds of requests
_PATIENCE = 20.0  # s, for an answer


class User:
    """Keeps some jobs open, in a thread, until it is told that these are enough.

    Parameters
    ----------
    mix
        What is submitted, in turn.
    at_once
        How many jobs are kept open.
    seed
        Of what is cancelled.
    key
        Of a service that asks for one.
    """

    def __init__(
        self,
        service: Service,
        mix: Sequence[Document],
        at_once: int,
        seed: int,
        key: str | None = None,
    ) -> None:
        self._headers = {} if key is None else {"Authorization": f"Bearer {key}"}
        self.history = History()
        self._service = service
        self._mix = mix
        self._at_once = at_once
        self._seed = seed
        self._drawn = random.Random(seed)  # noqa: S311 - repeatable on purpose
        self._enough = threading.Event()
        self._gone = threading.Event()
        self._failure: Exception | None = None
        self._thread = threading.Thread(target=self._use, name="user", daemon=True)

    def start(self) -> None:
        """Begin to submit."""
        self._thread.start()

    def submit_no_more(self) -> None:
        """Have it only look at what is open, and submit what was never answered."""
        self._enough.set()

    @property
    def satisfied(self) -> bool:
        """Whether it wants no more, and every job of its has ended."""
        if self._failure is not None:
            raise self._failure
        return self._enough.is_set() and not self.history.open

    def leave(self) -> None:
        """End the thread."""
        self._gone.set()
        self._thread.join()

    def _use(self) -> None:
        try:
            with httpx.Client(headers=self._headers, trust_env=False, timeout=_PATIENCE) as http:
                while not self._gone.wait(_PAUSE):
                    self._look(http)
        except Exception as failure:  # noqa: BLE001 - raised where it is waited for
            self._failure = failure

    def _look(self, http: httpx.Client) -> None:
        history = self.history
        if not self._enough.is_set() and len(history.open) < self._at_once:
            number = len(history.submissions)
            key = f"chaos-{self._seed}-{number}"
            cancel = self._drawn.randrange(_ONE_CANCELLED_OF) == 0
            history.submissions.append(Submission(key, number % len(self._mix), cancel))
        for submission in history.open:
            if self._gone.is_set():
                return
            self._attend(http, submission)
        self._ask(http, "GET", "/healthz")

    def _attend(self, http: httpx.Client, submission: Submission) -> None:
        if submission.job is None:
            document = self._mix[submission.template] | {"cache": False}
            key = {"Idempotency-Key": submission.key}
            answer = self._ask(http, "POST", "/v1/jobs", json=document, headers=key)
            if answer is not None:
                self.history.accepted(submission, answer["id"])
            return
        if submission.cancel and not submission.cancelled and submission.state == "running":
            answer = self._ask(http, "POST", f"/v1/jobs/{submission.job}/cancel")
            submission.cancelled = answer is not None
        answer = self._ask(http, "GET", f"/v1/jobs/{submission.job}")
        if answer is not None:
            self.history.seen(submission, answer)

    def _ask(self, http: httpx.Client, method: str, path: str, **named: Any) -> Any:
        """Return the answer, or none where there was none; note what must not be answered."""
        try:
            answer = http.request(method, self._service.url + path, **named)
        except httpx.TransportError:
            self.history.count(f"{method}: none")
            return None
        status = answer.status_code
        self.history.count(f"{method}: {status}")
        if answer.is_success:
            return answer.json()
        in_flight = status == httpx.codes.CONFLICT and method == "POST"  # its key is being answered
        if in_flight or (status in _REFUSALS and "Retry-After" in answer.headers):
            return None
        self.history.violations.append(
            f"{method} {path} was answered with {status}: {answer.text[:300]}"
        )
        return None
