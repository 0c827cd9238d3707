"""Content of a packed file that is in memory."""


class InMemory:
    """Bytes of a name to be read by ranges."""

    def __init__(self, name: str, content: bytes) -> None:
        self._name = name
        self._content = content

    def __str__(self) -> str:
        return self._name

    def size(self) -> int:
        """Return how many there are."""
        return len(self._content)

    def read(self, start: int, stop: int) -> bytes:
        """Return bytes [start, stop)."""
        return self._content[start:stop]
