"""Where ``jointplay plot`` writes: into a folder, or one figure into a file that is named."""

from pathlib import Path
from typing import NamedTuple

from jointplay.command_line.exits import Stopped
from jointplay.records.figure_form import FILM_FORMS, FORMS

_UNKNOWN_FORMS = ("jpg", "jpeg", "tif", "tiff", "bmp", "webp", "ps", "avi", "mov")
"""Endings of files that are no figures: a folder of such a name is not meant."""


class FigurePaths(NamedTuple):
    """A folder, and the name of the only file where that was given."""

    folder: Path
    file: str = ""

    def path(self, name: str, form: str) -> Path:
        """Return where a figure goes; its folder is there from then on."""
        self.folder.mkdir(parents=True, exist_ok=True)
        return self.folder / (self.file or f"{name}.{form}")


def figure_paths(
    output: Path, names: list[str] | None, form: str | None
) -> tuple[FigurePaths, str | None]:
    """Return where figures go, and their form: that of a file by its ending.

    Raises
    ------
    Stopped
        One file is named for several figures, or its ending is not the form that is asked for.
    """
    ending = output.suffix.removeprefix(".")
    if ending.lower() in _UNKNOWN_FORMS and not output.is_dir():
        known = ", ".join((*FORMS, *FILM_FORMS))
        raise Stopped(f"--output {output}: figures are written as {known}, not as {ending}.")
    if output.is_dir() or ending not in (*FORMS, *FILM_FORMS):
        return FigurePaths(output), form
    if names is None or len(names) != 1:
        raise Stopped(f"--output {output} is one file: name one figure, or a folder.")
    if form not in (None, ending):
        raise Stopped(f"--format {form} is not that of '{output.name}': leave one of them out.")
    return FigurePaths(output.parent, output.name), ending
