"""What becomes of a run at each end of the ranges, as a table in Markdown.

A run that is done has finite samples, and its energy ledger closes to within ten tolerances of the
gross work; one that fails or is refused says what to change.
The longest, 10 000 revolutions of the press, takes minutes.
"""

from benchmarks.extreme_cases import ALL, outcome_of


def main() -> None:
    """Print the table, a row as soon as it is known."""
    print("| case | outcome | steps | onsets | residual / (tolerance * gross work) |")
    print("|---|---|---|---|---|")
    for case in ALL:
        found = outcome_of(case)
        ended = found.ended if found.finite else f"{found.ended}, not finite"
        print(
            f"| {case.id} | {ended} | {found.steps} | {found.onsets} | {found.closure:.2g} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
