"""Printed values: the publication's numbers, their locations, and the parameters of each."""

import json
import math
from collections.abc import Mapping
from functools import cache
from importlib import resources
from typing import Any

SETTINGS = {
    "clearance_mm": ("clearance", 1e-3),
    "friction": ("friction", 1.0),
    "omega_over_pi": ("speed", math.pi),
}
"""Settings of the document as parameters of the scene: name, and what one is in SI."""
_UNITS = {"clearance_mm": "mm", "rpm": "rpm"}


@cache
def document() -> dict[str, Any]:
    """Return `reported_values.json`."""
    text = resources.files("jointplay.paper").joinpath("reported_values.json").read_text("utf-8")
    loaded: dict[str, Any] = json.loads(text)
    return loaded


def parameters(entry: Mapping[str, Any]) -> dict[str, float]:
    """Return the scene's parameters [SI] that an entry of the document belongs to."""
    return {
        name: si(setting, float(entry[setting]))
        for setting, (name, _) in SETTINGS.items()
        if setting in entry
    }


def si(setting: str, value: float) -> float:
    """Return a setting of the document in SI units, without noise from the conversion."""
    return float(f"{value * SETTINGS[setting][1]:.15g}")


def case_name(entry: Mapping[str, Any]) -> str:
    """Return the settings of an entry for readers, such as ``0.5 mm, friction 0.1, 1.5π rad/s``."""
    return ", ".join(
        in_words(setting, entry[setting]) for setting in (*SETTINGS, "rpm") if setting in entry
    )


def in_words(setting: str, value: float) -> str:
    """Return one setting of the document for readers."""
    if setting == "omega_over_pi":
        return "π rad/s" if value == 1.0 else f"{value:g}π rad/s"
    return f"friction {value:g}" if setting == "friction" else f"{value:g} {_UNITS[setting]}"
