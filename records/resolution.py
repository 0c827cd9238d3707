"""Resolution of a window: what its numbers were computed from, and how far apart that is."""

from dataclasses import dataclass
from typing import Any, Literal, Self

Basis = Literal["steps", "motion", "intervals", "samples"]


@dataclass(frozen=True)
class Resolution:
    """Basis of a window's numbers.

    Attributes
    ----------
    basis
        ``steps``: the run's own, so that nothing is between the numbers that was not looked at;
        ``motion``: the same, of an ideal mechanism, which needs no steps; ``intervals``: extremes
        of the trajectory from each sample to the next; ``samples``: only what the samples show.
    spacing
        From a sample to the next where the basis is intervals or samples, s.
    since
        Time, s, from which extremes are of intervals; before, they are of steps.
    """

    basis: Basis
    spacing: float | None = None
    since: float | None = None

    @classmethod
    def from_document(cls, document: dict[str, Any] | None) -> Self | None:
        """Read what a service says; None where it says nothing."""
        return None if document is None else cls(**document)


def of_samples(job: dict[str, Any]) -> Resolution:
    """Return the resolution of the samples of a run, from its job's document."""
    return Resolution("samples", float(job["output_step"]))
