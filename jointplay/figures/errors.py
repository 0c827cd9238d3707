"""What can go wrong when a figure is asked for."""

from collections.abc import Sequence


class FigureError(Exception):
    """Base of every error of this package; its text is a full sentence."""


class UnknownFigure(FigureError):
    """There is no figure of that name."""

    def __init__(self, name: str, known: Sequence[str]) -> None:
        super().__init__(
            f"there is no figure {name!r}; there are {', '.join(known)}, and every stored channel"
        )


class NotDrawable(FigureError):
    """These results, or this selection, do not hold what the figure needs."""
