"""Declared parameters: values from a job go to the places in the document that they name."""

import copy
import math
from collections.abc import Mapping
from difflib import get_close_matches
from typing import Any

from solver.errors import InvalidInput, Problem
from solver.scene.document import Parameter, Scene


def set_parameters(
    document: Mapping[str, Any], scene: Scene, values: Mapping[str, object], pointer: str
) -> tuple[dict[str, Any], dict[str, float | str | None]]:
    """Return the document with its parameters set, and every parameter's value.

    Parameters are applied in the order of their declaration, so that a later one overrides an
    earlier one on the same target. `pointer` is where `values` stand in the job.

    Raises
    ------
    InvalidInput
        A name that is not declared, or a value outside its declared range or choices.
    """
    problems = [
        Problem(f"{pointer}/{name}", f"There is no parameter '{name}'; {_near(name, scene)}.")
        for name in values
        if name not in scene.parameters
    ]
    filled = copy.deepcopy(dict(document))
    echo: dict[str, float | str | None] = {}
    for name, parameter in scene.parameters.items():
        value = values.get(name, parameter.default)
        complaint = None if value is None else _complaint(name, parameter, value)
        if complaint is not None:
            problems.append(Problem(f"{pointer}/{name}", complaint))
            continue
        value = float(value) if isinstance(value, int | float) else value
        echo[name] = value if isinstance(value, float | str) else None
        if value is not None:
            for target in parameter.targets:
                placed = value * target.factor if isinstance(value, float) else value
                _place(filled, target.path, placed)
    if problems:
        raise InvalidInput(problems)
    return filled, echo


def parameter_of(scene: Scene, echo: Mapping[str, float | str | None], path: str) -> str | None:
    """Return the parameter whose value stands at a place in the document, or None."""
    found = [
        name
        for name, parameter in scene.parameters.items()
        if echo.get(name) is not None and any(t.path == path for t in parameter.targets)
    ]
    return found[-1] if found else None


def targeted_paths(scene: Scene) -> frozenset[str]:
    """Every place in the document that a declared parameter may change."""
    return frozenset(
        target.path for parameter in scene.parameters.values() for target in parameter.targets
    )


def has_place(document: Any, path: str) -> bool:
    """Whether a JSON pointer leads to a value, or to a field beside existing ones."""
    *parents, last = path.strip("/").split("/")
    for key in parents:
        if isinstance(document, list) and key.isdigit() and int(key) < len(document):
            document = document[int(key)]
        elif isinstance(document, dict) and key in document:
            document = document[key]
        else:
            return False
    return isinstance(document, dict) or (
        isinstance(document, list) and last.isdigit() and int(last) < len(document)
    )


def _complaint(name: str, parameter: Parameter, value: object) -> str | None:
    if parameter.choices is not None:
        if value in parameter.choices:
            return None
        return f"'{name}' is one of {', '.join(parameter.choices)}."
    if isinstance(value, bool) or not isinstance(value, int | float):
        return f"'{name}' is a number in {parameter.unit}."
    below = parameter.minimum is not None and value < parameter.minimum
    above = parameter.maximum is not None and value > parameter.maximum
    if below or above or not math.isfinite(value):
        low = "any" if parameter.minimum is None else f"{parameter.minimum:g}"
        high = "any" if parameter.maximum is None else f"{parameter.maximum:g}"
        unit = "" if parameter.unit == "1" else f" {parameter.unit}"
        return f"'{name}' is {value:g}; it lies between {low} and {high}{unit}."
    return None


def _place(document: Any, path: str, value: object) -> None:
    *parents, last = path.strip("/").split("/")
    for key in parents:
        document = document[int(key)] if isinstance(document, list) else document[key]
    if isinstance(document, list):
        document[int(last)] = value
    else:
        document[last] = value


def _near(name: str, scene: Scene) -> str:
    near = get_close_matches(name, scene.parameters, n=1)
    if near:
        return f"did you mean '{near[0]}'?"[:-1]
    declared = ", ".join(scene.parameters) or "none"
    return f"'{scene.name}' declares {declared}"
