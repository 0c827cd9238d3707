"""The publication's experiment, whose data do not suffice to compute it."""

from collections.abc import Iterator
from typing import Final

from jointplay.paper import reported
from jointplay.paper.comparison import Cell, Row

_QUANTITIES: Final = {
    "single_plot_peak": "peak of the acceleration, both in one plot",
    "cycle30_experiment": "cycle 30, experiment",
    "cycle30_theory": "cycle 30, theory",
}


def rows() -> Iterator[Row]:
    """List what is printed, and how far its experiment and its theory are apart."""
    for index, entry in enumerate(reported.document()["test_bed"]):
        for key, words in _QUANTITIES.items():
            cell = Cell("not computed")
            if key == "cycle30_theory":
                ratio = entry["cycle30_experiment"] / entry[key]
                cell = Cell("not computed", (f"their experiment is {ratio:.2f} times this",))
            pointer = f"/test_bed/{index}/{key}"
            where = f"{entry['where']}: {reported.case_name(entry)}"
            yield Row((pointer,), where, f"{words}, m/s²", f"{entry[key]:g}", (cell,), ("bed",))
