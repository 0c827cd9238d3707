"""Speed of a film: how slow it shows a motion, and how many frames a second."""

from dataclasses import dataclass
from typing import Final

from jointplay.figures.kind import NotDrawable

_LEAST_RATE, _MOST_RATE = 1e-6, 1e3
_LEAST_FREQUENCY, _MOST_FREQUENCY = 1, 60
LASTING: Final = 6.0
"""Seconds that a film lasts whose rate nobody chose."""


@dataclass(frozen=True)
class Pace:
    """Speed of a film; what is None is chosen so that it lasts 6 s, never above real time.

    Parameters
    ----------
    rate
        Seconds of motion in one second of film.
    frames_per_second
        Of the film.
    impact_to_impact
        A frame in the middle of each impact, instead of at even times; there is no rate then.

    Raises
    ------
    NotDrawable
        A value that is out of its range; `cause` names it.
    """

    rate: float | None = None
    frames_per_second: int = 20
    impact_to_impact: bool = False

    def __post_init__(self) -> None:
        """Check them."""
        if self.rate is not None and self.impact_to_impact:
            sentence = "A film from impact to impact has no rate; leave one of them out."
            raise NotDrawable(sentence, "rate")
        if self.rate is not None and not _LEAST_RATE <= self.rate <= _MOST_RATE:
            sentence = f"The rate is {self.rate:g}; it lies between {_LEAST_RATE:g} (slow motion)"
            raise NotDrawable(f"{sentence} and {_MOST_RATE:g}, and 1 is real time.", "rate")
        if not _LEAST_FREQUENCY <= self.frames_per_second <= _MOST_FREQUENCY:
            sentence = f"{self.frames_per_second} frames a second cannot be; choose between"
            sentence += f" {_LEAST_FREQUENCY} and {_MOST_FREQUENCY}."
            raise NotDrawable(sentence, "frames_per_second")
