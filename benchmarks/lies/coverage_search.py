"""The search for error bars that are too short, and its tables."""

import json
from collections import Counter
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np

from benchmarks.lies.climbing import Found, climb
from benchmarks.lies.covered import Verdict, coverage_of
from benchmarks.lies.job import random_job
from benchmarks.lies.tables import KEYS, grouped, percent, table

WORST = 10
"""Jobs that are printed, to be repeated."""


class Judged(NamedTuple):
    """A job and what became of its claims."""

    kind: str
    job: dict[str, Any]
    verdict: Verdict


def search(seed: int, runs: int, kinds: list[str]) -> list[Judged]:
    """Judge jobs that a search for the worst coverage, then the worst error in bars, finds."""
    judged: list[Judged] = []

    def look(point: list[float]) -> Found:
        chosen = random_job(point, kinds)
        verdict = coverage_of(chosen.job)
        judged.append(Judged(chosen.kind, chosen.job, verdict))
        badness = None
        if verdict.ended == "judged":
            badness = 1.0 - verdict.covered + 1e-3 * float(np.log10(verdict.worst + 1e-12))
        return Found(f"{chosen.kind} {chosen.job['method']}", chosen.drawn, badness)

    climb(seed, runs, look)
    return judged


def report(judged: Iterable[Judged]) -> str:
    """Return tables by scene, method and tolerance, and the worst jobs as JSON."""
    judged = list(judged)
    ended = Counter(each.verdict.ended.split(":")[0] for each in judged)
    lines = [", ".join(f"{count} {what}" for what, count in ended.most_common())]
    true = [each for each in judged if each.verdict.ended == "judged"]
    heads = ("runs", "errors inside", "worst run", "runs below 95 %", "worst error in bars")
    for name in KEYS:
        rows = [_row(value, group) for value, group in grouped(name, true).items()]
        lines += ["", table((name, *heads, "median bar / error"), rows)]
    true.sort(key=lambda each: (each.verdict.covered, -each.verdict.worst))
    lines += ["", f"The {WORST} worst:"]
    for each in true[:WORST]:
        found = each.verdict
        said = f"{percent(found.covered)} inside, {found.worst:.3g} bars: {found.where}"
        lines += ["", said, json.dumps(each.job)]
    return "\n".join(lines)


def _row(name: str, group: list[Judged]) -> tuple[str, ...]:
    verdicts = [each.verdict for each in group]
    inside, errors = sum(v.inside for v in verdicts), sum(v.errors for v in verdicts)
    ratios = np.concatenate([v.ratios for v in verdicts])
    covered = [v.covered for v in verdicts]
    return (
        name,
        str(len(group)),
        percent(inside / errors),
        percent(min(covered)),
        str(sum(share < 0.95 for share in covered)),
        f"{max(v.worst for v in verdicts):.3g}",
        f"{np.median(ratios):.3g}" if len(ratios) else "",
    )
