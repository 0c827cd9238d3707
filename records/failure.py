"""Refusals and failures of the solver; HTTP and storage are unknown here."""

from collections.abc import Iterable
from typing import NamedTuple, Self


class Problem(NamedTuple):
    """One thing wrong with an input document."""

    pointer: str
    """RFC 6901 pointer into the document, e.g. ``/scene/parameters/clearance``."""
    detail: str
    """One sentence: what is wrong and what would be right."""


class InvalidInput(Exception):
    """A document that cannot be run, with every problem that was found."""

    def __init__(self, problems: Iterable[Problem]) -> None:
        self.problems = tuple(problems)
        super().__init__("; ".join(f"{p.pointer}: {p.detail}" for p in self.problems))

    @classmethod
    def at(cls, pointer: str, detail: str) -> Self:
        """Return the refusal of one field; see `Problem`."""
        return cls([Problem(pointer, detail)])


class LimitExceeded(InvalidInput):
    """A document that asks for more than is allowed; the sentence gives the estimate."""


class SimulationFailed(Exception):
    """A run that ended early; what was computed until `time` stands.

    Attributes
    ----------
    code : str
        ``step-size-underflow``, ``step-limit``, ``time-limit``, ``onset-not-located``,
        ``outside-of-a-function`` or ``assembly-lost``.
    detail : str
        When, where and what to try.
    time : float
        Simulated time reached, s.
    """

    def __init__(self, code: str, detail: str, time: float) -> None:
        self.code = code
        self.detail = detail
        self.time = time
        super().__init__(detail)
