"""Checks of declared parameters: what they set must exist, be theirs, and be in their unit."""

from collections.abc import Iterator

from jointplay.records.failure import Problem
from jointplay.solver.quantities.units import NOT_COHERENT
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.parameters import leads_to_value


def parameter_problems(scene: Scene) -> Iterator[Problem]:
    """Yield what is wrong with declared parameters; pointers begin at the scene."""
    document = scene.model_dump()
    setting: dict[str, str] = {}  # by path the first parameter that sets it
    for name, parameter in scene.parameters.items():
        always = parameter.required or parameter.default is not None
        low, high = parameter.minimum, parameter.maximum
        if low is not None and high is not None and low > high:
            yield Problem(
                f"/parameters/{name}/minimum", f"The minimum {low:g} is above the maximum {high:g}."
            )
        known = NOT_COHERENT.get(parameter.unit)
        if known and any(abs(target.factor) == 1.0 for target in parameter.targets):
            yield Problem(
                f"/parameters/{name}/unit",
                f"Numbers count in {known}, not {parameter.unit}: give the unit {known} and values"
                " in it, or each target the factor that converts them.",
            )
        for index, target in enumerate(parameter.targets):
            pointer = f"/parameters/{name}/targets/{index}/path"
            if not leads_to_value(document, target.path):
                sentence = f"'{target.path}' leads nowhere in this scene; name a single value."
                yield Problem(pointer, sentence)
            other = setting.setdefault(target.path, name)
            if always and other != name:
                yield Problem(
                    pointer,
                    f"'{name}' always has a value, so what '{other}' before it sets here has no"
                    f" effect; drop one of the two, or the default of '{name}'.",
                )
