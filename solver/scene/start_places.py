"""Numbers of a start that may vary from point to point, as declared parameters do.

A place is a JSON pointer into a scene: a coordinate of its start, or the phase of a driver.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

from jointplay.records.suggestions import unknown
from jointplay.solver.scene.document import Parameter, Scene, Target

_NAME: Final = r"([A-Za-z][A-Za-z0-9_-]{0,31})"
_POINT: Final = r"([A-Za-z][A-Za-z0-9_-]{0,31}\.[A-Za-z][A-Za-z0-9_-]{0,31})"


@dataclass(frozen=True)
class StartPlace:
    """A number of a start, or two of a vector in world axes."""

    path: str
    """With the part's name as NAME, or as POINT with one of its points; a vector without index."""
    part: str
    """Field of the scene that has the part."""
    name: str
    """Word that stands behind the part's name in the number's own name."""
    unit: str
    """Unit of the number; the phase of a driver that slides has m."""
    is_vector: bool = False

    @property
    def pattern(self) -> str:
        """Regular expression of its pointers."""
        path = self.path.replace("NAME", _NAME).replace("POINT", _POINT)
        return path + ("/([01])" if self.is_vector else "")


PLACES: Final = (
    StartPlace("/start/angles/NAME", "bodies", "angle", "rad"),
    StartPlace("/start/points/POINT", "bodies", "place", "m", is_vector=True),
    StartPlace("/start/angular_velocities/NAME", "bodies", "angular_velocity", "rad/s"),
    StartPlace("/start/velocities/NAME", "bodies", "velocity", "m/s", is_vector=True),
    StartPlace("/start/joints/NAME/eccentricity", "joints", "eccentricity", "m", is_vector=True),
    StartPlace("/start/joints/NAME/rate", "joints", "eccentricity_rate", "m/s", is_vector=True),
    StartPlace("/start/guides/NAME/offset", "joints", "offset", "m"),
    StartPlace("/start/guides/NAME/tilt", "joints", "tilt", "rad"),
    StartPlace("/start/guides/NAME/rate", "joints", "offset_rate", "m/s"),
    StartPlace("/start/guides/NAME/tilt_rate", "joints", "tilt_rate", "rad/s"),
    StartPlace("/drivers/NAME/position", "drivers", "position", "rad"),
)
PATTERN: Final = "^(" + "|".join(place.pattern for place in PLACES) + ")$"
"""Regular expression of all pointers."""


def name_of(pointer: str) -> str:
    """Return the name of a number of a start: ``stop.eccentricity_x``, ``motor.position``."""
    place, name, index = _read(pointer)
    return f"{name}.{place.name}" + ("" if index is None else f"_{'xy'[index]}")


def obstacle(scene: Scene, pointer: str) -> str:
    """Return why a scene has no such number, as a sentence; empty: it has."""
    place, name, _ = _read(pointer)
    parts: Mapping[str, Any] = getattr(scene, place.part)
    owner, _, point = name.partition(".")
    if owner not in parts:
        kind = {"bodies": "body", "joints": "joint", "drivers": "driver"}[place.part]
        return unknown(kind, owner, parts)
    if point and point not in parts[owner].points:
        return unknown("point", name, [f"{owner}.{one}" for one in parts[owner].points])
    return ""


def with_places(
    document: Mapping[str, Any], scene: Scene, pointers: Sequence[str]
) -> tuple[dict[str, Any], Scene]:
    """Return a scene in which numbers of its start are declared parameters, and its document.

    The document has every such number, zero where it did not give it; the scene does not have the
    numbers yet. A number whose part there is not is left out.
    """
    filled, parameters = dict(document), dict(scene.parameters)
    for pointer in pointers:
        if obstacle(scene, pointer):
            continue
        place, name, index = _read(pointer)
        driven = scene.drivers[name].joint if place.part == "drivers" else None
        unit = "m" if driven and scene.joints[driven].freedom == "slide" else place.unit
        filled = _with_zero(filled, pointer.strip("/").split("/"), index)
        parameters[name_of(pointer)] = Parameter(
            help=f"Of the start: {pointer}.", unit=unit, targets=[Target(path=pointer)]
        )
    return filled, scene.model_copy(update={"parameters": parameters})


def _read(pointer: str) -> tuple[StartPlace, str, int | None]:
    """Return what a pointer leads to, the part's name, and the index into a vector."""
    for place in PLACES:
        found = re.fullmatch(place.pattern, pointer)
        if found:
            return place, found[1], int(found[2]) if place.is_vector else None
    raise ValueError(f"{pointer!r} is no number of a start")


def _with_zero(node: Any, keys: list[str], index: int | None) -> Any:
    """Return a document in which something stands at a pointer; a vector is given whole."""
    if not keys or (index is not None and len(keys) == 1):
        return node if node is not None else (0.0 if index is None else [0.0, 0.0])
    key, *rest = keys
    inner = dict(node or {})
    inner[key] = _with_zero(inner.get(key), rest, index)
    return inner
