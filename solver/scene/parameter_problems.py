"""Checks of declared parameters: what they set must exist, be theirs, and be in their unit."""

import re
from collections.abc import Iterator

from jointplay.records.failure import Problem
from jointplay.solver.quantities.units import NOT_COHERENT
from jointplay.solver.scene.document import Parameter, Scene
from jointplay.solver.scene.parameters import leads_to_value

_ABOUT = re.compile(r"/(name|description|source|parameters/.+|reported/.+|outputs/\d+/help)")
"""Pointers to what a document says about its mechanism."""


def parameter_problems(scene: Scene) -> Iterator[Problem]:
    """Yield what is wrong with declared parameters; pointers begin at the scene."""
    document = scene.model_dump()
    setting: dict[str, str] = {}  # by path the first parameter that sets it
    for name, parameter in scene.parameters.items():
        low, high = parameter.minimum, parameter.maximum
        if low is not None and high is not None and low > high:
            yield Problem(
                f"/parameters/{name}/minimum", f"The minimum {low:g} is above the maximum {high:g}."
            )
        if parameter.choices is not None:
            yield from _of_words(name, parameter)
        known = NOT_COHERENT.get(parameter.unit)
        if known and any(abs(target.factor) == 1.0 for target in parameter.targets):
            yield Problem(
                f"/parameters/{name}/unit",
                f"Numbers count in {known}, not {parameter.unit}: give the unit {known} and values"
                " in it, or each target the factor that converts them.",
            )
        for index, target in enumerate(parameter.targets):
            pointer = f"/parameters/{name}/targets/{index}"
            if target.factor == 0.0:
                sentence = (
                    f"It sets 0 whatever '{name}' is; give another factor, or drop the target."
                )
                yield Problem(f"{pointer}/factor", sentence)
            if _ABOUT.fullmatch(target.path):
                sentence = f"'{target.path}' has no effect on the mechanism; name a value of that."
                yield Problem(f"{pointer}/path", sentence)
            elif not leads_to_value(scene, document, target.path):
                sentence = f"'{target.path}' leads nowhere in this scene; name a single value."
                yield Problem(f"{pointer}/path", sentence)
        yield from _set_twice(name, parameter, setting)


def _of_words(name: str, parameter: Parameter) -> Iterator[Problem]:
    """Yield what a parameter whose values are words has of one whose values are numbers."""
    bounds = {field: getattr(parameter, field) for field in ("minimum", "maximum")}
    numbers = [field for field, bound in bounds.items() if bound is not None]
    scaled = enumerate(target.factor != 1.0 for target in parameter.targets)
    numbers += [f"targets/{index}/factor" for index, one in scaled if one]
    for field in numbers:
        sentence = f"The values of '{name}' are words, its 'choices'; leave this out."
        yield Problem(f"/parameters/{name}/{field}", sentence)


def _set_twice(name: str, parameter: Parameter, setting: dict[str, str]) -> Iterator[Problem]:
    """Yield what a parameter sets again, and what it must set in place of those before it.

    A default may: in a scene given whole it is how a value is given.
    """
    own = [target.path for target in parameter.targets]
    for index, path in enumerate(own):
        pointer = f"/parameters/{name}/targets/{index}/path"
        other = setting.setdefault(path, name)
        if path in own[:index]:
            yield Problem(pointer, f"'{name}' sets '{path}' twice; name it once.")
        elif parameter.required and other != name:
            yield Problem(
                pointer,
                f"'{name}' must be given, so what '{other}' before it sets here has no effect;"
                f" drop one of the two, or do not require '{name}'.",
            )
