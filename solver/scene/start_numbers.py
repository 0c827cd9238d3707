"""Numbers of a start that may vary from point to point, as declared parameters do.

Each has a JSON pointer into a scene: a coordinate of its start, or the phase of a driver.
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
class StartNumber:
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


NUMBERS: Final = (
    StartNumber("/start/angles/NAME", "bodies", "angle", "rad"),
    StartNumber("/start/points/POINT", "bodies", "position", "m", is_vector=True),
    StartNumber("/start/angular_velocities/NAME", "bodies", "angular_velocity", "rad/s"),
    StartNumber("/start/velocities/NAME", "bodies", "velocity", "m/s", is_vector=True),
    StartNumber("/start/joints/NAME/eccentricity", "joints", "eccentricity", "m", is_vector=True),
    StartNumber("/start/joints/NAME/rate", "joints", "eccentricity_rate", "m/s", is_vector=True),
    StartNumber("/start/guides/NAME/offset", "joints", "offset", "m"),
    StartNumber("/start/guides/NAME/tilt", "joints", "tilt", "rad"),
    StartNumber("/start/guides/NAME/rate", "joints", "offset_rate", "m/s"),
    StartNumber("/start/guides/NAME/tilt_rate", "joints", "tilt_rate", "rad/s"),
    StartNumber("/drivers/NAME/position", "drivers", "position", "rad"),
)
PATTERN: Final = "^(" + "|".join(number.pattern for number in NUMBERS) + ")$"
"""Regular expression of all pointers."""


def name_of(pointer: str) -> str:
    """Return the name of a number of a start: ``stop.eccentricity_x``, ``motor.position``."""
    number, name, index = _read(pointer)
    return f"{name}.{number.name}" + ("" if index is None else f"_{'xy'[index]}")


def obstacle(scene: Scene, pointer: str) -> str:
    """Return why a scene has no such number, as a sentence; empty: it has."""
    number, name, _ = _read(pointer)
    parts: Mapping[str, Any] = getattr(scene, number.part)
    part, _, point = name.partition(".")
    if part not in parts:
        kind = {"bodies": "body", "joints": "joint", "drivers": "driver"}[number.part]
        return unknown(kind, part, parts)
    if point and point not in parts[part].points:
        return unknown("point", name, [f"{part}.{one}" for one in parts[part].points])
    return ""


def with_start_numbers(
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
        number, name, index = _read(pointer)
        driven = scene.drivers[name].joint if number.part == "drivers" else None
        unit = "m" if driven and scene.joints[driven].freedom == "slide" else number.unit
        filled = _with_zero(filled, pointer.strip("/").split("/"), index)
        parameters[name_of(pointer)] = Parameter(
            help=f"Of the start: {pointer}.", unit=unit, targets=[Target(path=pointer)]
        )
    return filled, scene.model_copy(update={"parameters": parameters})


def _read(pointer: str) -> tuple[StartNumber, str, int | None]:
    """Return what a pointer leads to, the part's name, and the index into a vector."""
    for number in NUMBERS:
        found = re.fullmatch(number.pattern, pointer)
        if found:
            return number, found[1], int(found[2]) if number.is_vector else None
    raise ValueError(f"{pointer!r} is no number of a start")


def _with_zero(node: Any, keys: list[str], index: int | None) -> Any:
    """Return a document in which something stands at a pointer; a vector is given whole."""
    if not keys or (index is not None and len(keys) == 1):
        return node if node is not None else (0.0 if index is None else [0.0, 0.0])
    key, *rest = keys
    inner = dict(node or {})
    inner[key] = _with_zero(inner.get(key), rest, index)
    return inner
