"""The scene with what was found as its defaults, each marked as inferred, with its spread."""

import copy
from typing import Any

from pydantic import ValidationError

from jointplay.records.failure import InvalidInput
from jointplay.solver.calibration.outcome import Outcome
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.sentences import schema_problems

LONGEST_HELP = 300
LONGEST_DESCRIPTION = 2000


def fitted_scene(outcome: Outcome, name: str) -> dict[str, Any]:
    """Return the scene document of that name.

    What the calibration set in its scene becomes a default, too, since the fit holds with it.

    Raises
    ------
    InvalidInput
        The name is none that a scene may have.
    """
    calibration = outcome.calibration
    document = copy.deepcopy(calibration.scene_document)
    document["name"] = name
    for parameter, value in calibration.given.items():
        document["parameters"][parameter]["default"] = value
    quantiles = outcome.quantiles()
    for k, parameter in enumerate(calibration.space.names):
        declared = document["parameters"][parameter]
        note = f" Fitted; 90 % of what fits equally well: {quantiles[0, k]:.3g} to "
        note += f"{quantiles[-1, k]:.3g}."
        declared["help"] = declared["help"][: LONGEST_HELP - len(note)] + note
        declared["default"] = float(outcome.best[k])
        declared["inferred"] = True
    note = f" Inferred: {', '.join(calibration.space.names)}, by a fit to {_targets(outcome)}"
    note += f" (root mean square of the misses {outcome.cost:.2g} tolerances)."
    if calibration.document["description"]:
        note += f" {calibration.document['description']}"
    said = document.get("description", "")
    document["description"] = (said + note)[:LONGEST_DESCRIPTION]
    try:
        Scene.model_validate(document)
    except ValidationError as error:
        raise InvalidInput(schema_problems(error, Scene, document)) from None
    return document


def _targets(outcome: Outcome) -> str:
    fitted = [
        target for case in outcome.calibration.cases for target in case.targets if target.weight > 0
    ]
    channels = ", ".join(dict.fromkeys(target.channel for target in fitted))
    return f"{len(fitted)} number{'s' if len(fitted) > 1 else ''} of {channels}"
