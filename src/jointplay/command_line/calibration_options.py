"""A calibration's document from what was typed: a file, or a scene and options."""

from collections.abc import Sequence
from typing import Any

from jointplay.command_line.exits import Stopped
from jointplay.command_line.job_document import is_scene_file, job_document
from jointplay.command_line.typed_file import is_read

_STATISTICS = ("maximum", "minimum", "range", "maximum_time", "minimum_time")


def calibration_document(
    source: str,
    *,
    settings: Sequence[str],
    fits: Sequence[str],
    targets: Sequence[str],
    duration: float | None,
    search: dict[str, Any],
    spread: dict[str, Any],
    tolerance: float | None,
) -> dict[str, Any]:
    """Return the calibration that ``source`` and the options describe; nothing is checked yet.

    ``source`` is the path of a calibration, of what one left (it is repeated), or of a scene; or
    a preset.  The rest is as it was typed; without targets they are what the scene's source
    reports.  ``search`` and ``spread`` are fields of the parts of that name; those that are None
    are left as they are.
    """
    free = dict(map(_fit, fits))
    whole = is_read(source) and not is_scene_file(source)
    given = job_document(source, settings=settings, options={})
    if whole:
        document = given.get("calibration", given)
        if settings and document is not given:
            line = f"{source} is what a calibration left; --set would make another one of it."
            raise Stopped(line)
        if targets:
            line = f"{source} has its targets already; --target makes them for a scene or a preset."
            raise Stopped(line)
    else:
        document = {"kind": "calibration", "scene": given["scene"], "parameters": {}}
        document["cases"] = _cases(given["scene"], targets, duration)
    if not isinstance(document, dict):
        raise Stopped(f"{source}: 'calibration' is a JSON object.")
    if free:
        parameters = document.get("parameters")
        document["parameters"] = (parameters if isinstance(parameters, dict) else {}) | free
    if not document.get("parameters"):
        raise Stopped("Nothing may move: give --fit NAME=MIN:MAX, such as stiffness=1e8:1e11:log.")
    for part, fields in (("search", search), ("spread", spread)):
        changed = {name: value for name, value in fields.items() if value is not None}
        before = document.get(part, {})
        if changed and isinstance(before, dict):
            document[part] = before | changed
    if tolerance is not None:
        document.pop("accuracy", None)
        document["tolerance"] = tolerance
    return document


def _cases(
    scene: dict[str, Any], targets: Sequence[str], duration: float | None
) -> list[dict[str, Any]]:
    from jointplay.solver.kinds.reported_cases import reported_cases
    from jointplay.solver.scene import presets

    if targets:
        return [{"targets": [_target(text, duration) for text in targets]}]
    cases = reported_cases(presets.document(scene["preset"]) if "preset" in scene else scene)
    if not cases:
        line = "The scene reports no numbers: give --target, such as A.normal_force@0:0.01=500."
        raise Stopped(line)
    return cases


def _fit(text: str) -> tuple[str, dict[str, object]]:
    name, equals, bounds = text.partition("=")
    parts = bounds.split(":")
    if not (name and equals) or len(parts) not in (2, 3) or parts[2:] not in ([], ["log"]):
        raise Stopped(f"--fit {text}: write NAME=MIN:MAX, and :log after it for equal ratios.")
    low, high = (_number("--fit", part) for part in parts[:2])
    spacing = {"spacing": "log"} if parts[2:] else {}
    return name, {"minimum": low, "maximum": high, **spacing}


def _target(text: str, duration: float | None) -> dict[str, object]:
    """Return the target of ``channel[:statistic][@from:to]=value``."""
    place, equals, value = text.partition("=")
    place, _, window = place.partition("@")
    channel, colon, statistic = place.partition(":")
    start, _, stop = window.partition(":")
    if not (channel and equals and value) or (colon and statistic not in _STATISTICS):
        raise Stopped(
            f"--target {text}: write CHANNEL=VALUE, such as A.normal_force@0:0.01=500; after the"
            f" channel may come :{', :'.join(_STATISTICS[1:])}."
        )
    if not stop and duration is None:
        line = f"--target {text}: give the window as CHANNEL@FROM:TO=VALUE, or a --duration."
        raise Stopped(line)
    return {
        "channel": channel,
        "statistic": statistic or "maximum",
        "from": _number("--target", start) if start else 0.0,
        "to": _number("--target", stop) if stop else duration,
        "value": _number("--target", value),
    }


def _number(option: str, text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise Stopped(f"{option}: {text!r} is not a number.") from None
