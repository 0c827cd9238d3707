"""The search for extremes that are wrong, and its tables."""

import json
from collections import Counter
from collections.abc import Iterable
from typing import Any, NamedTuple

from benchmarks.lies.climbing import Found, climb
from benchmarks.lies.extremes import ALLOWED, Extremes, extremes_of
from benchmarks.lies.job import random_job
from benchmarks.lies.tables import KEYS, grouped, percent, table

WORST = 10
"""Jobs that are printed, to be repeated."""


class Judged(NamedTuple):
    """A job and what became of its extremes."""

    kind: str
    job: dict[str, Any]
    found: Extremes


def search(seed: int, runs: int, kinds: list[str]) -> list[Judged]:
    """Judge jobs that a search for the largest miss finds."""
    judged: list[Judged] = []

    def look(point: list[float]) -> Found:
        chosen = random_job(point, kinds)
        found = extremes_of(chosen.job)
        judged.append(Judged(chosen.kind, chosen.job, found))
        badness = found.worst if found.ended == "judged" else None
        return Found(f"{chosen.kind} {chosen.job['method']}", chosen.drawn, badness)

    climb(seed, runs, look)
    return judged


def report(judged: Iterable[Judged]) -> str:
    """Return tables by scene, method and tolerance, and the worst jobs as JSON."""
    judged = list(judged)
    ended = Counter(each.found.ended.split(":")[0] for each in judged)
    lines = [", ".join(f"{count} {what}" for what, count in ended.most_common())]
    true = [each for each in judged if each.found.ended == "judged"]
    for name in KEYS:
        rows = [_row(value, group) for value, group in grouped(name, true).items()]
        heads = (name, "runs", f"extremes within {ALLOWED:g}", "runs with a miss", "worst miss")
        lines += ["", table(heads, rows)]
    true.sort(key=lambda each: -each.found.worst)
    lines += ["", f"The {WORST} worst:"]
    for each in true[:WORST]:
        said = f"{each.found.worst:.3g} of its range: {each.found.where}"
        lines += ["", said, json.dumps(each.job)]
    return "\n".join(lines)


def _row(name: str, group: list[Judged]) -> tuple[str, ...]:
    found = [each.found for each in group]
    right, extremes = sum(f.right for f in found), sum(f.extremes for f in found)
    return (
        name,
        str(len(group)),
        percent(right / extremes),
        str(sum(f.right < f.extremes for f in found)),
        f"{max(f.worst for f in found):.2g}",
    )
