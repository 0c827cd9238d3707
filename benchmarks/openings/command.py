"""The command ``python -m benchmarks openings``, repeatable from a seed."""

import argparse
import json
from collections import Counter

from benchmarks.openings.search import SETTINGS, Searched, search, soft_contacts

AJAR = 1e-11
"""A gap inside a contact, m, that is more than rounding."""

TOLD = 10
"""Jobs that are printed, to be repeated."""


def main() -> None:
    """Search, and print what was missed."""
    options = argparse.ArgumentParser(prog="python -m benchmarks openings", description=__doc__)
    options.add_argument("--runs", type=int, default=1000, help="soft contacts")
    options.add_argument("--seed", type=int, default=1)
    given = options.parse_args()
    found = list(search(soft_contacts(given.seed, given.runs)))
    print(f"seed {given.seed}, {given.runs} soft contacts")
    for setting in SETTINGS:
        print(_row(setting, [each for each in found if each.setting == setting]))
    wrong = [each for each in found if each.judgement.missed or each.judgement.made_up]
    for each in wrong[:TOLD]:
        print(f"\nmissed at {each.judgement.missed}, made up at {each.judgement.made_up}, s:")
        print(json.dumps(each.job))


def _row(setting: str, found: list[Searched]) -> str:
    """Return what became of the runs with one setting."""
    ended = Counter(each.ended for each in found)
    judgements = [each.judgement for each in found]
    return (
        f"{setting:10s} {dict(ended)}: {sum(j.judged for j in judgements)} openings judged,"
        f" {sum(len(j.missed) for j in judgements)} missed"
        f" in {sum(bool(j.missed) for j in judgements)} runs,"
        f" {sum(len(j.made_up) for j in judgements)} made up;"
        f" {sum(each.ajar > AJAR for each in found)} runs with a gap inside a contact,"
        f" to {max(each.ajar for each in found):.3g} m;"
        f" onsets off by {max(j.late for j in judgements):.2g} s at most"
    )
