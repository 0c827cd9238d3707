"""One run of an accuracy-study as it ended."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Point:
    """A method at a tolerance, or with a step (s): its cost and its error.

    `admitted` : whether jobs may ask for it. `error` : root mean square over the window and the
    coordinates and speeds, each relative to the scale that tolerances are relative to; none where
    the run did not come to its end, which `failure` then explains. `astray` : energy lost track of,
    as a share of what contacts and friction took. `seconds` : of computing; of everything here
    they alone differ when the study is repeated.
    """

    method: str
    tolerance: float | None
    step: float | None
    admitted: bool
    error: float | None
    astray: float | None
    steps: int
    evaluations: int
    seconds: float
    failure: str | None

    @property
    def name(self) -> str:
        """Method and tolerance or step, as a job asks for them."""
        if self.tolerance is None:
            return f"{self.method} in steps of {self.step:g} s"
        return f"{self.method} at {self.tolerance:.0e}"
