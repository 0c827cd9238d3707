"""Figures of a store into files."""

from pathlib import Path
from typing import TYPE_CHECKING, Literal

from jointplay.command_line.progress import progress

if TYPE_CHECKING:
    from jointplay.figures import Selection
    from jointplay.source import Source
    from jointplay.study_source import StudySource

Form = Literal["png", "svg"]


def draw_all(source: "Source | StudySource", folder: Path, form: Form) -> list[Path]:
    """Draw every kind of figure that the results allow into a folder, and return the files.

    A single output is not drawn once more on its own: the figure of all outputs shows it.
    """
    from jointplay import figures

    kinds = {kind.name for kind in figures.ROSTER} | {kind.name for kind in figures.STUDY_ROSTER}
    names = [figure.name for figure in figures.available(source) if figure.name in kinds]
    return draw(source, names, folder, form)


def draw(
    source: "Source | StudySource",
    names: list[str],
    folder: Path,
    form: Form,
    selection: "Selection | None" = None,
) -> list[Path]:
    """Draw the named figures into a folder, and return the files."""
    from jointplay import figures

    folder.mkdir(parents=True, exist_ok=True)
    written = []
    with progress("figures") as report:
        for done, name in enumerate(names):
            report(done / len(names), name)
            path = folder / f"{name}.{form}"
            path.write_bytes(figures.render(source, name, form, selection))
            written.append(path)
        report(1.0, "")
    return written
