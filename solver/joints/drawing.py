"""Drawing of a type of joint: what it says itself of the marks by which it is drawn."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Literal, NamedTuple

NOWHERE: Mapping[str, str] = MappingProxyType({})


class Drawing(NamedTuple):
    """The part of its marks that a type of joint says; see `records.joint_marks.Marks`."""

    sign: Literal["pin", "weld", ""] = "pin"
    supported: bool = False
    axis: str = ""
    size: str = ""
    block: tuple[str, str] | None = None
    circles: tuple[tuple[int, str], ...] = ()
    cam: Mapping[str, str] = NOWHERE
    places: tuple[tuple[float, float], ...] = ((0.0, 0.0),)
    """Places of its contact pairs, in their order."""
    picture: Literal["journal", "walls", "surface", ""] = ""
    caption: str = ""
