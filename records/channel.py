"""A channel: a named quantity with its SI unit."""

from typing import NamedTuple


class Channel(NamedTuple):
    """Name, SI unit and meaning of a quantity that is stored, computed or drawn."""

    name: str
    unit: str
    """SI unit, ``m/s^2`` for example; ``1`` for a pure number."""
    long_name: str = ""
    """The quantity in a few words."""

    @property
    def attributes(self) -> dict[str, str]:
        """Attributes of its array by the CF conventions."""
        return {"units": self.unit, "long_name": self.long_name}
