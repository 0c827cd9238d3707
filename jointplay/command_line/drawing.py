"""Figures of a store into files."""

from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Final, Literal

from jointplay.progress import progress

if TYPE_CHECKING:
    from collections.abc import Callable

    from jointplay.client import Job
    from jointplay.local.drawing_process import DrawingProcess

Form = Literal["png", "svg"]

_LONGEST: Final = ("certificate", "spectrum", "phase-portrait", "outputs", "contact-force", "orbit")
"""Figures that take longest to draw, begun first."""


def draw_all(job: "Job", folder: Path, second: "DrawingProcess | None" = None) -> None:
    """Draw every kind of figure that the results allow into a folder.

    A single output is not drawn once more on its own: the figure of all outputs shows it.

    Parameters
    ----------
    job
        Its results are there; with a second process, in a folder.
    folder
        Made if it is missing.
    second
        A process that draws some of them.
    """
    from jointplay import figures

    names = [name for name in job.figures if name in {**figures.ROSTER, **figures.STUDY_ROSTER}]
    folder.mkdir(parents=True, exist_ok=True)
    with progress("figures") as report:
        drawn = set() if second is None else _draw_shared(job, folder, names, second, report)
        for done, name in enumerate(names):
            if name not in drawn:
                report(done / len(names), name)
                job.figure(name).save(folder / name)
        report(1.0, "")


def _draw_shared(
    job: "Job",
    folder: Path,
    names: Sequence[str],
    second: "DrawingProcess",
    report: "Callable[[float, str], None]",
) -> set[str]:
    """Draw with a second process, and return what is drawn.

    What fails is left out: drawn again, alone and in its turn, it says why.
    """
    rank = {name: place for place, name in enumerate(_LONGEST)}
    names = sorted(names, key=lambda name: rank.get(name, len(rank)))
    drawn = set()
    for place in second.share(Path(job.id), folder, names):
        report(place / len(names), names[place])
        with suppress(Exception):
            job.figure(names[place]).save(folder / names[place])
            drawn.add(place)
    return {names[place] for place in drawn | second.drawn()}
