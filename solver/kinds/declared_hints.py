"""Hints at what a scene declares without an effect: widths that no law uses, other units."""

from collections.abc import Collection, Iterator, Mapping
from typing import Any

from jointplay.records.failure import Problem
from jointplay.solver.quantities.dimensions import dimensions
from jointplay.solver.scene.document import Parameter, Scene
from jointplay.solver.scene.unit_at import unit_at


def idle_widths(
    written: Mapping[str, Any], scene: Scene, setting: Collection[str]
) -> Iterator[Problem]:
    """Yield the widths of bearings that are given and that no law of theirs uses.

    written : the document without fields that were filled in. setting : pointers to what parameters
    may change; a law among it may use the width.
    """
    for name, joint in written.get("joints", {}).items():
        given = joint.get("clearance") or {}
        slack = scene.joints[name].slack
        path = f"/joints/{name}/clearance"
        if slack is None or given.get("bearing_width") is None:
            continue
        used = any(rule.field == "bearing_width" for rule in slack.rules)
        chosen = any(one.startswith(f"{path}/contact/") and one.endswith("/law") for one in setting)
        if not used and not chosen:
            yield Problem(
                f"{path}/bearing_width",
                "No law of this clearance uses the bearing_width: stiffness laws of line contact"
                " and films of oil do. 'jointplay laws stiffness' lists the laws.",
            )


def other_units(scene: Scene) -> Iterator[Problem]:
    """Yield the parameters whose unit is not that of a number that takes their value as it is."""
    document = scene.model_dump()
    for name, parameter in scene.parameters.items():
        found = None if parameter.choices else _other_unit(document, parameter)
        if found is not None:
            path, unit = found
            yield Problem(
                f"/parameters/{name}/unit",
                f"'{path}' counts in {unit}, and takes the value of '{name}' as it is, whose unit"
                f' is said to be {parameter.unit}: give "unit": "{unit}", or the target the'
                " factor that converts it.",
            )


def _other_unit(document: Mapping[str, Any], parameter: Parameter) -> tuple[str, str] | None:
    """Return the first target that takes a value in another unit, and that unit."""
    told = dimensions(parameter.unit)
    for target in parameter.targets:
        unit = unit_at(document, target.path) if abs(target.factor) == 1.0 else None
        own = None if unit is None else dimensions(unit)
        if unit is not None and None not in (told, own) and told != own:
            return target.path, unit
    return None
