"""Outcome of a run at each end of the ranges, as a table in Markdown.

A run that is done has finite samples, its energy ledger closes to within ten tolerances of the
gross work, and while it is converged its certificate covers its true error; one that fails or is
refused says what to change. The longest, 10 000 revolutions of the press, takes minutes.
"""

import math

from benchmarks.extreme_cases import ALL, Case, coverage_of, outcome_of

HEADS = (
    "case",
    "outcome",
    "steps",
    "onsets",
    "residual / (tolerance * gross work)",
    "converged",
    "errors covered",
)


def main() -> None:
    """Print the table, a row as soon as it is known."""
    print(f"| {' | '.join(HEADS)} |")
    print("|---" * len(HEADS) + "|")
    for case in ALL:
        found = outcome_of(case)
        ended = found.ended if found.finite else f"{found.ended}, not finite"
        cells = [case.id, ended, str(found.steps), str(found.onsets), f"{found.closure:.2g}"]
        cells += believed(case) if found.ended == "done" else ["", ""]
        print(f"| {' | '.join(cells)} |", flush=True)


def believed(case: Case) -> list[str]:
    """Return the share of instants that are converged, and of errors there that are covered."""
    found = coverage_of(case.job)
    if found is None:
        return ["", "no reference"]
    covered = "no truth" if math.isnan(found.covered) else f"{100.0 * found.covered:.2f} %"
    return [f"{100.0 * found.converged:.0f} %", covered]


if __name__ == "__main__":
    main()
