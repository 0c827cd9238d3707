"""Printed values: the publication's numbers, their places, and the parameters of each."""

import json
import math
from collections.abc import Iterator, Mapping
from functools import cache
from importlib import resources
from typing import Any

SETTINGS = {
    "clearance_mm": ("clearance", 1e-3),
    "friction": ("friction", 1.0),
    "omega_over_pi": ("speed", math.pi),
}
"""Settings of the document as parameters of the scene: name, and what one is in SI."""

_KINDS = ("ideal", "response_peaks", "adams_comparison", "phase_ranges", "test_bed")
"""Parts of the document that hold measured or computed numbers."""


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
    words = []
    if "clearance_mm" in entry:
        words.append(f"{entry['clearance_mm']:g} mm")
    if "friction" in entry:
        words.append(f"friction {entry['friction']:g}")
    if "omega_over_pi" in entry:
        words.append(f"{turning(entry['omega_over_pi'])} rad/s")
    if "rpm" in entry:
        words.append(f"{entry['rpm']:g} rpm")
    return ", ".join(words)


def turning(omega_over_pi: float) -> str:
    """Return a speed as a multiple of π, as in ``1.5π``."""
    return "π" if omega_over_pi == 1.0 else f"{omega_over_pi:g}π"


def pointers() -> set[str]:
    """Return the JSON pointers of all printed numbers; settings are not among them."""
    return {pointer for kind in _KINDS for pointer in _numbers(document()[kind], f"/{kind}")}


def _numbers(value: Any, pointer: str) -> Iterator[str]:
    if isinstance(value, dict):
        for key, inner in value.items():
            if key not in (*SETTINGS, "rpm"):
                yield from _numbers(inner, f"{pointer}/{key}")
    elif isinstance(value, list):
        for index, inner in enumerate(value):
            yield from _numbers(inner, f"{pointer}/{index}")
    elif isinstance(value, int | float):
        yield pointer
