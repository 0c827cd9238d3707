"""Names of the rows of a work array, ``work[slot, lane]``, in their order."""

from collections.abc import Sequence

INSTANTS = 8
"""Instants of one step that are looked at together, however many lanes there are."""
BUNDLE = 8
"""Runs side by side in a bundle, however many lanes there are."""
BENDS = 2
"""Slip speeds at which a law of friction may bend."""
MOTION = 6
"""Numbers of a journal's motion in the world's axes: eccentricity, m, its rate and acceleration."""


class Layout:
    """Hands out slots by name, in order; single ones, and blocks of consecutive ones."""

    def __init__(self) -> None:
        self._slots: dict[str, int] = {}
        self._blocks: dict[str, slice] = {}

    @property
    def size(self) -> int:
        """Number of slots."""
        return len(self._slots)

    def add(self, *names: str) -> None:
        """Give a slot to each name.

        Raises
        ------
        KeyError
            A name has one already.
        """
        for name in names:
            self._take(name, [name])

    def add_block(self, name: str, count: int) -> None:
        """Give consecutive slots to ``name0, name1, …``; `count` may be 0."""
        self._take(name, [f"{name}{i}" for i in range(count)])

    def _take(self, block: str, names: Sequence[str]) -> None:
        if block in self._blocks or not self._slots.keys().isdisjoint(names):
            raise KeyError(f"'{block}' is taken")
        self._blocks[block] = slice(self.size, self.size + len(names))
        self._slots |= zip(names, range(self.size, self.size + len(names)), strict=True)

    def block(self, name: str) -> slice:
        """Return the slots of a block, or the one of a single name.

        Raises
        ------
        KeyError
            Nothing has that name.
        """
        found = self._blocks.get(name)
        return slice(self._slots[name], self._slots[name] + 1) if found is None else found

    def __getitem__(self, name: str) -> int:
        return self._slots[name]

    def __contains__(self, name: str) -> bool:
        return name in self._slots
