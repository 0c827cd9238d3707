"""A scene seen through abstract scalars: the same names, every number replaced by a scalar."""

from collections.abc import Callable, Collection
from functools import cache
from typing import Any, cast

from pydantic import BaseModel

from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.parameters import targeted_paths

NumberOf = Callable[[str, float], Scalar]
"""Turns the number at a JSON pointer of the scene into a scalar."""

LEFT_OUT = frozenset({"start", "period", "parameters", "reported"})
FOLDED = {"points": (0.0,), "axis": None}
"""Geometry that shapes the equations unless a declared parameter may change it: exact zeros among
the coordinates of points, any component of an axis."""


def plain_number(_path: str, value: float) -> float:
    """Return the number itself: the view on which the readable reference runs."""
    return value


def view(scene: Scene, number: NumberOf = plain_number) -> Scene:
    """Return a scene whose numbers went through `number`; nothing of it is checked again.

    Values that decide the form of the equations (an exactly zero coordinate, friction switched
    off, the exponent 1.5) stay plain floats, so that they are folded away. The start, the period,
    parameters and reported values are left out. Plain numbers are those of the scene itself.
    """
    if number is plain_number:
        return scene
    seen = _View(number, targeted_paths(scene)).of_model(scene, "", LEFT_OUT)
    return cast(Scene, seen)


def form(scene: Scene) -> str:
    """Return what a scene's equations and outputs depend on, but for numbers of a run."""
    return repr((view(scene, lambda _path, _value: ...), scene.outputs))


class _View:
    def __init__(self, number: NumberOf, targeted: Collection[str]) -> None:
        self.number = number
        self.targeted = targeted

    def of_model(self, model: BaseModel, path: str, without: Collection[str] = ()) -> BaseModel:
        fields = {}
        for name, structural in _fields(type(model)).items():
            if name not in without:
                fields[name] = self.of(getattr(model, name), f"{path}/{name}", structural, name)
        return type(model).model_construct(**fields)

    def of(self, value: Any, path: str, structural: Any, field: str) -> Any:
        if value is None or isinstance(value, str):
            return value
        if isinstance(value, BaseModel):
            return self.of_model(value, path)
        if isinstance(value, dict):
            return {k: self.of(v, f"{path}/{k}", (), field) for k, v in value.items()}
        if isinstance(value, list):
            return [self.of(v, f"{path}/{i}", (), field) for i, v in enumerate(value)]
        if not isinstance(value, float | int) or isinstance(value, bool):
            return value
        folded = value in structural
        if field in FOLDED and path not in self.targeted:
            values = FOLDED[field]
            folded = values is None or value in values
        return float(value) if folded else self.number(path, float(value))


@cache
def _fields(model: type[BaseModel]) -> dict[str, Any]:
    """Return which values of each field shape the equations."""
    extras = {name: field.json_schema_extra for name, field in model.model_fields.items()}
    return {
        name: extra.get("structural", ()) if isinstance(extra, dict) else ()
        for name, extra in extras.items()
    }
