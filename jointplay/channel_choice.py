"""Channels by name or glob, and what was probably meant when there is no such channel."""

from collections.abc import Sequence
from difflib import get_close_matches
from fnmatch import fnmatchcase

_LONGEST_SHOWN = 80
_MOST_LISTED = 12


class NoSuchChannel(ValueError):
    """One or more names or globs match nothing; ``sentences`` has one for each."""

    def __init__(self, sentences: Sequence[str]) -> None:
        super().__init__(" ".join(sentences))
        self.sentences = tuple(sentences)


def choose(text: str | None, names: Sequence[str]) -> list[str]:
    """Return the channels that a comma-separated list of names and globs means.

    Parameters
    ----------
    text
        For example ``"slider7.*,A.normal_force"``; all channels if None.
    names
        The channels there are.

    Returns
    -------
    list of str
        In the order of ``names``.

    Raises
    ------
    NoSuchChannel
        Something in the list matches nothing; the sentences name near channels.
    """
    if text is None:
        return list(names)
    patterns = [pattern.strip() for pattern in text.split(",") if pattern.strip()]
    unknown = [p for p in patterns if not any(fnmatchcase(name, p) for name in names)]
    if unknown:
        raise NoSuchChannel([_suggestion(pattern[:_LONGEST_SHOWN], names) for pattern in unknown])
    if not patterns:
        raise NoSuchChannel(["The list of channels is empty; name some, or leave it out."])
    return [name for name in names if any(fnmatchcase(name, p) for p in patterns)]


def _suggestion(pattern: str, names: Sequence[str]) -> str:
    near = get_close_matches(pattern, names, n=3, cutoff=0.5)
    if near:
        return f"There is no channel {pattern!r}; did you mean {' or '.join(near)}?"
    listed = ", ".join(names[:_MOST_LISTED]) + (", …" if len(names) > _MOST_LISTED else "")
    return f"There is no channel {pattern!r}; there are {listed}."
