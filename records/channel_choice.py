"""Channels by name or glob, and what was probably meant when there is no such channel."""

from collections.abc import Sequence
from difflib import get_close_matches
from fnmatch import fnmatchcase

from jointplay.records.quantity_terms import in_other_terms

_LONGEST_PATTERN = 80  # the longest name of a channel has 64 characters
_SPECIAL = frozenset("*?[")
_MOST_GLOBS = 500  # each is held against every channel
_MOST_NAMED = 20  # what is wrong, so often; a near name takes 10 ms to find
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
        In the order in which the text names them; those of one glob in the order of ``names``.

    Raises
    ------
    NoSuchChannel
        Something in the list matches nothing; the sentences name near channels.
    """
    if text is None:
        return list(names)
    patterns, known = _patterns(text), set(names)
    if not patterns:
        raise NoSuchChannel(["The list of channels is empty; name some, or leave it out."])
    globs = {pattern for pattern in patterns if not _SPECIAL.isdisjoint(pattern)}
    if len(globs) > _MOST_GLOBS:
        raise NoSuchChannel([f"The list has {len(globs)} globs; give at most {_MOST_GLOBS}."])
    found = {p: _matching(p, names) if p in globs else [p] * (p in known) for p in patterns}
    unknown = [pattern for pattern in patterns if not found[pattern]]
    if unknown:
        raise no_such_channel(unknown, names)
    return list(dict.fromkeys(name for pattern in patterns for name in found[pattern]))


def no_such_channel(unknown: Sequence[str], names: Sequence[str]) -> NoSuchChannel:
    """Return the error that says of each unknown name or glob what was probably meant."""
    return NoSuchChannel([_suggestion(pattern, names) for pattern in unknown[:_MOST_NAMED]])


def _patterns(text: str) -> list[str]:
    given = (pattern.strip() for pattern in text.split(","))
    return list(dict.fromkeys(pattern for pattern in given if pattern))


def _matching(pattern: str, names: Sequence[str]) -> list[str]:
    if len(pattern) > _LONGEST_PATTERN:
        return []
    return [name for name in names if fnmatchcase(name, pattern)]


def _suggestion(pattern: str, names: Sequence[str]) -> str:
    pattern = pattern[:_LONGEST_PATTERN]
    near = in_other_terms(pattern, names) or get_close_matches(pattern, names, n=3, cutoff=0.5)
    if near:
        return f"There is no channel {pattern!r}; did you mean {' or '.join(near)}?"
    listed = ", ".join(names[:_MOST_LISTED]) + (", …" if len(names) > _MOST_LISTED else "")
    return f"There is no channel {pattern!r}; there are {listed}."
