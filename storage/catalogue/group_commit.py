"""Work that many threads ask for at the same time, done together: they wait for one disk once."""

import threading
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, field
from typing import Generic, TypeVar

Asked = TypeVar("Asked")
Answer = TypeVar("Answer")
_MOST = 256
"""Requests that are answered together."""


@dataclass(eq=False)
class _Request(Generic[Asked, Answer]):
    asked: Asked
    future: Future[Answer] = field(default_factory=Future)
    woken: threading.Event = field(default_factory=threading.Event)
    """Set when it is answered, or when it is its thread's turn to answer."""


class GroupCommit(Generic[Asked, Answer]):
    """Answers what has gathered while the requests before were being answered.

    No thread of its own: one of those that wait does the work of all.

    Parameters
    ----------
    answer
        Returns the answers to several requests, in their order, or raises and has done nothing.
    common
        What it raises when it would fail with any request. After other errors each request is
        tried alone, so that no request spoils another's.
    """

    def __init__(
        self, answer: Callable[[Sequence[Asked]], Sequence[Answer]], common: type[Exception]
    ) -> None:
        self._answer = answer
        self._common = common
        self._mutex = threading.Lock()
        self._waiting: deque[_Request[Asked, Answer]] = deque()
        self._busy = False

    def done(self, asked: Asked) -> Answer:
        """Return the answer to one request."""
        request: _Request[Asked, Answer] = _Request(asked)
        with self._mutex:
            self._waiting.append(request)
            waits, self._busy = self._busy, True
        if waits:
            request.woken.wait()
        if not request.future.done():
            self._answer_next()
        return request.future.result()

    def _answer_next(self) -> None:
        """Answer the requests at the head, this thread's before all, and have the next one go on.

        A lock would do to take turns, but whoever lets go of it and asks again has it at once,
        before a thread that waits for it has woken.
        """
        with self._mutex:
            count = min(len(self._waiting), _MOST)
            group = [self._waiting.popleft() for _ in range(count)]
        try:
            self._answer_all([(one.asked, one.future) for one in group])
        finally:
            for one in group:
                one.future.cancel()  # does nothing to one that is answered
                one.woken.set()
            with self._mutex:
                self._busy = bool(self._waiting)
                if self._waiting:
                    self._waiting[0].woken.set()

    def _answer_all(self, group: Sequence[tuple[Asked, Future[Answer]]]) -> None:
        try:
            answers = self._answer([asked for asked, _ in group])
        except Exception as error:  # noqa: BLE001 - the caller gets it
            if len(group) > 1 and not isinstance(error, self._common):
                for one in group:
                    self._answer_all([one])
                return
            for _, future in group:
                future.set_exception(error)
            return
        for (_, future), answer in zip(group, answers, strict=True):
            future.set_result(answer)
