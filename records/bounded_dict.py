"""A dict that remembers a bounded number of things."""

from collections.abc import Hashable
from typing import TypeVar

Key = TypeVar("Key", bound=Hashable)
Value = TypeVar("Value")


class BoundedDict(dict[Key, Value]):
    """A dict of at most so many keys: a new one takes the place of the one set longest ago."""

    def __init__(self, most: int) -> None:
        super().__init__()
        self._most = most

    def __setitem__(self, key: Key, value: Value) -> None:
        """Set a value; its key is forgotten last."""
        self.pop(key, None)
        while len(self) >= self._most:
            self.pop(next(iter(self)), None)
        super().__setitem__(key, value)
