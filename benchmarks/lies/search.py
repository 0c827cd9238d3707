"""A search for jobs whose claims are wrong, and its tables; a measure says by what they are."""

import json
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, Generic, NamedTuple, Protocol, TypeVar

from benchmarks.lies.climbing import Found, climb
from benchmarks.lies.job import random_job
from benchmarks.lies.tables import KEYS, grouped, table

WORST = 10
"""Jobs that are printed, to be repeated."""
BETWEEN = 50
"""Runs from one look at the tables to the next: a search that is ended early has told its own."""


class Verdict(Protocol):
    """Outcome of a job's claims."""

    @property
    def ended(self) -> str:
        """``judged``, or why it was not."""


V = TypeVar("V", bound=Verdict)


@dataclass(frozen=True)
class Measure(Generic[V]):
    """Judgement of the claims of jobs, and how it is told.

    Attributes
    ----------
    verdict : class of its judgements
    judge : of a job
    badness : what the search makes as large as it can, of a verdict
    heads, row : columns of a table, and their entries for the verdicts of a group
    sentence : about one verdict
    """

    verdict: type[V]
    judge: Callable[[dict[str, Any]], V]
    badness: Callable[[V], float]
    heads: tuple[str, ...]
    row: Callable[[list[V]], tuple[str, ...]]
    sentence: Callable[[V], str]


class Judged(NamedTuple):
    """A job and what became of its claims."""

    kind: str
    job: dict[str, Any]
    verdict: Any


def search(
    measure: Measure[V],
    seed: int,
    runs: int,
    kinds: list[str],
    tell: Callable[[list[Judged]], None] = lambda judged: None,
) -> list[Judged]:
    """Judge jobs that a search for the worst finds, and `tell` of those so far."""
    judged: list[Judged] = []

    def look(point: list[float]) -> Found:
        chosen = random_job(point, kinds)
        verdict = measure.judge(chosen.job)
        judged.append(Judged(chosen.kind, chosen.job, verdict))
        if len(judged) % BETWEEN == 0 or len(judged) == runs:
            tell(judged)
        badness = measure.badness(verdict) if verdict.ended == "judged" else None
        return Found(f"{chosen.kind} {chosen.job['method']}", chosen.drawn, badness)

    climb(seed, runs, look)
    return judged


def report(measure: Measure[V], judged: Iterable[Judged]) -> str:
    """Return tables by scene, method and tolerance, and the worst jobs as JSON."""
    judged = list(judged)
    ended = Counter(each.verdict.ended.split(":")[0] for each in judged)
    lines = [", ".join(f"{count} {what}" for what, count in ended.most_common())]
    true = [each for each in judged if each.verdict.ended == "judged"]
    for name in KEYS:
        groups = grouped(name, true).items()
        rows = [
            (value, str(len(group)), *measure.row([each.verdict for each in group]))
            for value, group in groups
        ]
        lines += ["", table((name, "runs", *measure.heads), rows)]
    true.sort(key=lambda each: -measure.badness(each.verdict))
    lines += ["", f"The {WORST} worst:"]
    for each in true[:WORST]:
        lines += ["", measure.sentence(each.verdict), json.dumps(each.job)]
    return "\n".join(lines)
