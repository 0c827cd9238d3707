"""Findings of a campaign: one document for programs, a table for people."""

from collections.abc import Iterator
from dataclasses import asdict, dataclass, field
from typing import Any

from jointplay.chaos.installation import LEASE

PROMPT = LEASE + 5.0
"""Seconds within which a held block goes on after a fault, on a machine that has time for it."""


@dataclass
class Struck:
    """One fault that struck."""

    fault: str
    at: float  # s since the campaign began
    lasted: float  # s, until it was undone
    held: int  # blocks that workers held when it struck
    recovery: float | None  # s from its end until all of them went on; none: one never did


@dataclass
class Report:
    """A campaign from its seed to what was wrong in the end."""

    seed: int
    duration: float  # s
    struck: list[Struck] = field(default_factory=list)
    left_out: dict[str, str] = field(default_factory=dict)  # faults, and why
    answers: dict[str, int] = field(default_factory=dict)
    jobs: dict[str, int] = field(default_factory=dict)  # by the state in which they ended
    lost: int = 0  # attempts that lost their block
    wrong: list[str] = field(default_factory=list)
    kept: str | None = None  # folder, if something was wrong

    def document(self) -> dict[str, Any]:
        """Return it as JSON has it."""
        return asdict(self)

    @classmethod
    def of_document(cls, document: dict[str, Any]) -> "Report":
        """Return the report that a document was made of."""
        struck = [Struck(**one) for one in document["struck"]]
        return cls(**(document | {"struck": struck}))

    def rows(self) -> Iterator[tuple[str, str, str, str, str]]:
        """Yield a table: what struck how often, blocks that were held, how soon they went on."""
        yield "fault", "times", "lasted up to [s]", "blocks held", "went on within [s]"
        for name in dict.fromkeys(one.fault for one in self.struck):
            those = [one for one in self.struck if one.fault == name]
            recoveries = [one.recovery for one in those]
            known = [seconds for seconds in recoveries if seconds is not None]
            worst = f"{max(known):.1f}" if len(known) == len(recoveries) else "never"
            held = sum(one.held for one in those)
            longest = max(one.lasted for one in those)
            yield name, str(len(those)), f"{longest:.0f}", str(held), worst if held else "-"

    def closing(self) -> Iterator[str]:
        """Yield what is to be said beside the table."""
        for name, why in self.left_out.items():
            yield f"{name} was left out: {why}"
        ended = ", ".join(f"{count} {state}" for state, count in sorted(self.jobs.items()))
        yield f"jobs: {ended}; attempts that lost their block: {self.lost}"
        counted = ", ".join(f"{answer} ({count})" for answer, count in sorted(self.answers.items()))
        yield f"answers: {counted}"
        late = [one for one in self.struck if one.recovery is None or one.recovery > PROMPT]
        if late:
            yield f"{len(late)} of {len(self.struck)} recoveries took longer than {PROMPT:g} s"
        yield from (f"WRONG: {sentence}" for sentence in self.wrong)
        if self.wrong:
            yield f"--seed {self.seed} repeats the schedule; everything is kept in {self.kept}"
        else:
            yield "every accepted job ended once, with the bytes of an undisturbed run"
