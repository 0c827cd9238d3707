"""Figures of a store into files."""

from pathlib import Path
from typing import TYPE_CHECKING, Literal

from jointplay.progress import progress

if TYPE_CHECKING:
    from jointplay.client import Job

Form = Literal["png", "svg"]


def draw_all(job: "Job", folder: Path) -> None:
    """Draw every kind of figure that the results allow into a folder.

    A single output is not drawn once more on its own: the figure of all outputs shows it.
    """
    from jointplay import figures

    kinds = {kind.name for kind in figures.ROSTER} | {kind.name for kind in figures.STUDY_ROSTER}
    names = [name for name in job.figures if name in kinds]
    folder.mkdir(parents=True, exist_ok=True)
    with progress("figures") as report:
        for done, name in enumerate(names):
            report(done / len(names), name)
            job.figure(name).save(folder / name)
        report(1.0, "")
