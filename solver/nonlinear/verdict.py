"""Verdicts on motions: their codes, and what is said with them."""

from dataclasses import dataclass

UNDECIDED, PERIODIC, QUASI_PERIODIC, CHAOTIC, EQUILIBRIUM = range(5)
VERDICTS = {
    "undecided": UNDECIDED,
    "periodic": PERIODIC,
    "quasi-periodic": QUASI_PERIODIC,
    "chaotic": CHAOTIC,
    "equilibrium": EQUILIBRIUM,
}
"""Codes as they are stored (unsigned byte); a code never changes its meaning."""


@dataclass(frozen=True)
class Verdict:
    """Kind of motion. `period`: in sections, 0 unless periodic. `reason`: one sentence."""

    code: int
    period: int
    reason: str

    @property
    def name(self) -> str:
        """The code in words; a periodic motion with its period, as in "period-3"."""
        if self.code == PERIODIC:
            return f"period-{self.period}"
        return next(name for name, code in VERDICTS.items() if code == self.code)


RESTING = 1e-5
"""Speeds and accelerations at rest are below this share of what counts as one in a time unit: far
less than sections may differ by that recur, for what is left of a transient moves more slowly."""
RESTS = Verdict(
    EQUILIBRIUM,
    0,
    "nothing moves at the end of the record: all speeds and accelerations are below"
    f" {RESTING:g} of what counts as one in a time unit",
)


def undecided(reason: str) -> Verdict:
    """Return the verdict that nothing is decided, and why."""
    return Verdict(UNDECIDED, 0, reason)
