"""Declared parameters: values from a job go where their pointers lead in the document."""

import copy
import math
import sys
from collections.abc import Collection, Iterable, Mapping
from typing import Any

from pydantic import BaseModel

from jointplay.records.failure import InvalidInput, Problem
from jointplay.records.suggestions import unknown
from jointplay.solver.scene.document import Parameter, Scene

POINTER = "/scene/parameters"
"""Pointer to where a job gives values, and a scene document declares parameters."""


def set_parameters(
    document: Mapping[str, Any],
    scene: Scene,
    values: Mapping[str, object],
    varied: Collection[str] = (),
) -> tuple[dict[str, Any], dict[str, float | str | None]]:
    """Return the document with its parameters set, and every parameter's value.

    Parameters are applied in the order of their declaration, so that a later one overrides an
    earlier one on the same target. What none of them changes is shared with the document given.
    Those `varied` have their values elsewhere, so that they may be required and yet not given.

    Raises
    ------
    InvalidInput
        A name that is not declared, a value outside its declared range or choices, a required one
        that is not given.
    """
    problems = undeclared(scene.parameters, values)
    filled = _Edited(document)
    echo: dict[str, float | str | None] = {}
    for name, parameter in scene.parameters.items():
        value = values.get(name, parameter.default)
        complaint = _complaint(name, parameter, value, varies=name in varied)
        if complaint is not None:
            own = name not in values and value is not None  # a default that the scene declares
            pointer = f"{POINTER}/{name}/default" if own else f"{POINTER}/{name}"
            problems.append(Problem(pointer, complaint))
            continue
        value = float(value) if isinstance(value, int | float) else value
        echo[name] = value if isinstance(value, float | str) else None
        if value is not None:
            for target in parameter.targets:
                scaled = value * target.factor if isinstance(value, float) else value
                filled.put(target.path, scaled)
    if problems:
        raise InvalidInput(problems)
    return filled.document, echo


def wrong_values(scene: Scene, values: Mapping[str, object]) -> list[Problem]:
    """Return a problem for every given value that is of no parameter or not one of its values."""
    declared = scene.parameters
    complaints = {
        name: _complaint(name, declared[name], value, varies=True)
        for name, value in values.items()
        if name in declared
    }
    wrong = [Problem(f"{POINTER}/{name}", text) for name, text in complaints.items() if text]
    return undeclared(declared, values) + wrong


def undeclared(declared: Collection[str], names: Iterable[str]) -> list[Problem]:
    """Return a problem for every name that no parameter has."""
    return [
        Problem(f"{POINTER}/{name}", unknown("parameter", name, declared))
        for name in names
        if name not in declared
    ]


def parameter_of(scene: Scene, echo: Mapping[str, float | str | None], path: str) -> str | None:
    """Return the parameter whose value stands at a pointer into the document, or None."""
    found = [
        name
        for name, parameter in scene.parameters.items()
        if echo.get(name) is not None and any(t.path == path for t in parameter.targets)
    ]
    return found[-1] if found else None


def targeted_paths(scene: Scene) -> frozenset[str]:
    """Pointers to all that declared parameters may change in the document."""
    return frozenset(
        target.path for parameter in scene.parameters.values() for target in parameter.targets
    )


def value_at(node: Any, path: str) -> Any:
    """Return what stands at a JSON pointer of a document or a part; None where nothing does."""
    for key in filter(None, path.split("/")):
        if isinstance(node, BaseModel):
            node = getattr(node, key, None)
        elif isinstance(node, Mapping):
            node = node.get(key)
        elif isinstance(node, list) and key.isdigit() and int(key) < len(node):
            node = node[int(key)]
        else:
            return None
    return node


def leads_to_value(scene: Scene, document: Any, path: str) -> bool:
    """Tell whether a JSON pointer leads to a single value of a scene, or to where one may be.

    What holds other values is not one: two parameters might then be put into each other.
    `document` : the scene's, with all fields. There may be the start angle or angular velocity of
    any body, and any field of what a parameter chooses by its law or type.
    """
    parents, _, last = path.rpartition("/")
    parent, value = value_at(document, parents), value_at(document, path)
    if isinstance(parent, list):
        known = last.isdigit() and int(last) < len(parent)
    elif parents in ("/start/angles", "/start/angular_velocities"):
        known = last in scene.bodies
    else:
        chosen = targeted_paths(scene) & {f"{parents}/law", f"{parents}/type"}
        known = isinstance(parent, dict) and (last in parent or bool(chosen))
    return known and not isinstance(value, dict | list)


def _complaint(name: str, parameter: Parameter, value: object, *, varies: bool) -> str | None:
    if value is None and parameter.required and not varies:
        return (
            f"'{name}' has no default and must be given; it {_allowed(parameter)}."
            f" {parameter.help.rstrip('.')}."
        )
    if value is None:
        if parameter.default is None:
            return None
        return f"'{name}' has the default {parameter.default}; leave it out to keep that."
    if parameter.choices is not None:
        known = value in parameter.choices
        return None if known else f"'{name}' is one of {', '.join(parameter.choices)}."
    unit = "" if parameter.unit == "1" else f" {parameter.unit}"
    if isinstance(value, bool) or not isinstance(value, int | float):
        return f"'{name}' is a number" + (f" in{unit}." if unit else ".")
    beyond_floats = isinstance(value, int) and abs(value) > sys.float_info.max
    return _outside(name, parameter, math.inf if beyond_floats else float(value), unit)


def _outside(name: str, parameter: Parameter, value: float, unit: str) -> str | None:
    low = -math.inf if parameter.minimum is None else parameter.minimum
    high = math.inf if parameter.maximum is None else parameter.maximum
    if low <= value <= high and math.isfinite(value):
        return None
    return f"'{name}' is {value:.12g}; it {allowed_range(parameter)}."


def _allowed(parameter: Parameter) -> str:
    """Return the end of a sentence about a parameter: its choices, or where it lies."""
    if parameter.choices is not None:
        return f"is one of {', '.join(parameter.choices)}"
    return allowed_range(parameter)


def allowed_range(parameter: Parameter) -> str:
    """Return the end of a sentence about a parameter's value: where it lies."""
    unit = "" if parameter.unit == "1" else f" {parameter.unit}"
    low, high = parameter.minimum, parameter.maximum
    if low is not None and high is not None:
        return f"lies between {low:g} and {high:g}{unit}"
    if low is not None:
        return f"is at least {low:g}{unit}"
    return f"is at most {high:g}{unit}" if high is not None else "is finite"


class _Edited:
    """A document into which values are put; what leads to them is copied, the rest is shared."""

    def __init__(self, document: Mapping[str, Any]) -> None:
        self.document = dict(document)
        self._copied: dict[tuple[str, ...], Any] = {(): self.document}

    def put(self, path: str, value: object) -> None:
        *parents, last = path.strip("/").split("/")
        node = self._copied_at(tuple(parents))
        node[_key(node, last)] = value

    def _copied_at(self, keys: tuple[str, ...]) -> Any:
        if keys not in self._copied:
            parent = self._copied_at(keys[:-1])
            key = _key(parent, keys[-1])
            self._copied[keys] = parent[key] = copy.copy(parent[key])
        return self._copied[keys]


def _key(node: Any, key: str) -> Any:
    return int(key) if isinstance(node, list) else key
