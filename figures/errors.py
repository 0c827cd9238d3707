"""Errors of asking for a figure."""

from collections.abc import Sequence


class FigureError(Exception):
    """Base of every error of this package; its text is a full sentence."""


class UnknownFigure(FigureError):
    """There is no figure of that name."""

    def __init__(self, name: str, known: Sequence[str]) -> None:
        super().__init__(
            f"There is no figure {name!r}; there are {', '.join(known)}, and every stored channel."
        )


class NotDrawable(FigureError):
    """These results, or this selection, do not hold what the figure needs.

    Attributes
    ----------
    cause : str
        What to change: ``name`` of the figure, or of the selection ``channels``, ``joints``,
        or ``start``.
    """

    def __init__(self, sentence: str, cause: str = "name") -> None:
        super().__init__(sentence)
        self.cause = cause


def at_most(most: int, names: Sequence[str]) -> tuple[str, ...]:
    """Return the channels of a figure's panels; `NotDrawable` if there are too many."""
    if len(names) > most:
        sentence = f"One figure shows at most {most} channels, not {len(names)}; choose fewer."
        raise NotDrawable(sentence, "channels")
    return tuple(names)
