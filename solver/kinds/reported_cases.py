"""Targets from the numbers that a scene's source printed."""

from typing import Any

from jointplay.solver.kinds.mechanism import with_parameters
from jointplay.solver.mechanics.assembly import assemble
from jointplay.solver.scene.document import Scene


def reported_cases(document: dict[str, Any]) -> list[dict[str, Any]]:
    """Return a scene's reported numbers as the cases of a calibration.

    Those of the ideal mechanism are left out: no contact moves them.

    Raises
    ------
    InvalidInput
        The scene's own parameters do not fit it.
    """
    scene = Scene.model_validate(document)
    cases: dict[tuple[tuple[str, float | str], ...], dict[str, Any]] = {}
    for entry in scene.reported:
        key = tuple(sorted(entry.parameters.items()))
        case = cases.setdefault(key, {"parameters": dict(entry.parameters), "targets": []})
        case["targets"].append(
            {
                "channel": entry.channel,
                "statistic": entry.statistic,
                "to": entry.duration,
                "value": entry.value,
                "note": f"{entry.where}. {entry.note}".strip()[:300],
            }
        )
    return [case for case in cases.values() if _plays(document, scene, case["parameters"])]


def _plays(document: dict[str, Any], scene: Scene, parameters: dict[str, float | str]) -> bool:
    found, _, _ = with_parameters(document, scene, dict(parameters))
    return assemble(found).freedom_with_play > 0
