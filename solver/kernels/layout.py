"""Where each quantity lives in the flat work array: W[slot * LANES + lane]."""

from __future__ import annotations

LANES = 8
"""Parameter sets that a kernel advances at once: one AVX-512 register of floats."""


class Layout:
    """Hands out slots by name, in order."""

    def __init__(self) -> None:
        self._slots: dict[str, int] = {}

    def copy(self) -> Layout:
        """Return a layout that begins with the same slots."""
        copied = Layout()
        copied._slots.update(self._slots)
        return copied

    @property
    def size(self) -> int:
        """Number of slots."""
        return len(self._slots)

    def add(self, *names: str) -> int:
        """Give consecutive slots to names that have none; return the first one's."""
        first = self.size
        for name in names:
            if name in self._slots:
                raise KeyError(f"slot '{name}' is taken")
            self._slots[name] = self.size
        return first

    def add_block(self, name: str, count: int) -> int:
        """Give `count` consecutive slots ``name0, name1, …``; return the first one's number."""
        return self.add(*(f"{name}{i}" for i in range(count)))

    def __getitem__(self, name: str) -> int:
        return self._slots[name]

    def __contains__(self, name: str) -> bool:
        return name in self._slots
