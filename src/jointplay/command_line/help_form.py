"""Form of the help of a command: in tables where the terminal is wide enough, else plainly."""

import shutil
from typing import Any, Final

from typer.core import TyperCommand

LEAST: Final = 110
"""Columns. Of 80, tables left 17 to the sentences about options, and cut names and choices off."""


class Command(TyperCommand):
    """A command whose help can be read on any terminal."""

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """Write the help."""
        if shutil.get_terminal_size().columns < LEAST:
            self.rich_markup_mode = None
        super().format_help(ctx, formatter)
