"""A channel: a named quantity with its SI unit."""

from collections.abc import Iterable
from typing import Final, NamedTuple


class Channel(NamedTuple):
    """Name, SI unit and meaning of a quantity that is stored, computed or drawn."""

    name: str
    unit: str
    """SI unit, ``m/s^2`` for example; ``1`` for a pure number."""
    long_name: str = ""
    """The quantity in a few words."""

    @property
    def title(self) -> str:
        """Title of its column in a table: name and unit."""
        return f"{self.name} [{self.unit}]"

    @property
    def attributes(self) -> dict[str, str]:
        """Attributes of its array by the CF conventions."""
        return {"units": self.unit, "long_name": self.long_name}


TIME: Final = Channel("time", "s", "time")


def by_name(channels: Iterable[Channel]) -> dict[str, Channel]:
    """Return channels by their names, in their order."""
    return {channel.name: channel for channel in channels}
