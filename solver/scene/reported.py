"""Checks of the numbers that a source printed: of which motion they are, and in what unit."""

from collections.abc import Iterator, Mapping

from pydantic import ValidationError

from jointplay.records.failure import InvalidInput, Problem
from jointplay.records.suggestions import unknown
from jointplay.solver.scene.channels import channels
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.parameters import set_parameters, wrong_values


def reported_problems(scene: Scene) -> Iterator[Problem]:
    """Yield what is wrong with them; pointers begin at the scene, whose other parts fit.

    Those of parameters that a copy of the scene has no more are left alone: nothing can use them.
    """
    known: dict[frozenset[tuple[str, float | str]], Mapping[str, str]] = {}
    for index, entry in enumerate(scene.reported):
        pointer = f"/reported/{index}"
        if wrong_values(scene, entry.parameters):
            continue
        run = frozenset(entry.parameters.items())
        try:
            units = known[run] = known.get(run) or _units(scene, entry.parameters)
        except InvalidInput:  # a default or an output, which is told by itself
            continue
        except ValidationError:
            yield Problem(f"{pointer}/parameters", "They do not fit the scene; give those printed.")
            continue
        unit = units.get(entry.channel)
        if unit is None:
            yield Problem(f"{pointer}/channel", unknown("channel", entry.channel, units))
        elif unit != entry.unit:
            sentence = f"'{entry.channel}' is in {unit}, not {entry.unit}: give the value in that."
            yield Problem(f"{pointer}/unit", sentence)


def _units(scene: Scene, values: Mapping[str, float | str]) -> Mapping[str, str]:
    """Return the units of all channels that there are with some parameters, by their names."""
    filled, _ = set_parameters(scene.model_dump(), scene, values, varied=scene.parameters)
    return {channel.name: channel.unit for channel in channels(Scene.model_validate(filled))}
