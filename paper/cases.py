"""The jobs of a reproduction, from what was printed: nothing here knows the mechanism."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from jointplay.paper import reported
from jointplay.paper.size import Size
from jointplay.paper.variants import Variant
from jointplay.solver.scene import presets

DURATION: Final = 2.0
"""Of the response to the start, s: one revolution at the slowest speed that was published."""
STEP: Final = 1e-4
"""Between samples, s: half of the publication's, and smooth enough for paths."""
LONG_STEP: Final = 2e-4
"""The same over many revolutions."""
JOINTS: Final = ("A", "B")
INDICATORS: Final = ("lyapunov", "zero_one", "recurrence", "rotation")
PATHS: Final = tuple(
    f"{joint}.eccentricity{rate}_{axis}"
    for joint in JOINTS
    for rate in ("", "_rate")
    for axis in "xy"
)
RESPONSE: Final = (
    "displacement",
    "velocity",
    "acceleration",
    "*.normal_force",
    "*.eccentricity_[xy]",
)
GRAVITIES: Final = {"forward": 1.0, "reversed": -1.0, "absent": 0.0}
"""Load cases of the comparison with another program: multiples of the scene's gravity."""
RANGED: Final = ("eccentricity_x", "eccentricity_rate_x")


STEPS: Final = {"clearance_mm": 0.005, "omega_over_pi": 0.01}
"""Between values of a diagram, in the unit of the setting: half the publication's or finer."""


@dataclass(frozen=True)
class Run:
    """One job and its place among the results; `weight` is about its seconds on one core."""

    name: str
    job: dict[str, Any]
    weight: float


def runs(size: Size) -> list[Run]:
    """Return all jobs of a reproduction."""
    found = list(_ideal())
    for variant in size.variants:
        found += [*_responses(variant), *_load_cases(variant), *_ranges(variant, size)]
    for variant in size.motions:
        found += [*_motions(variant, size), *_diagrams(variant, size)]
    return found


def gravity() -> float:
    """Return the scene's own gravity along the slider's guide, m/s^2."""
    scene = presets.document(reported.document()["scene"])
    return float(scene["parameters"]["gravity_x"]["default"])


def ideal(omega_over_pi: float) -> str:
    """Return the name of the run without clearance at a speed."""
    return f"ideal-{omega_over_pi:g}pi"


def response(case: int, variant: Variant) -> str:
    """Return the name of the run of an entry of `response_peaks`."""
    return f"response-{case}-{variant.name}"


def load_case(gravity: str, variant: Variant) -> str:
    """Return the name of the run under a gravity of `GRAVITIES`."""
    return f"gravity-{gravity}-{variant.name}"


def ranges(window: str, variant: Variant) -> str:
    """Return the name of the sweep over `phase_ranges` in the window ``early`` or ``late``."""
    return f"ranges-{window}-{variant.name}"


def portrait(case: int, variant: Variant) -> str:
    """Return the name of the run behind the phase portraits of an entry of `phase_ranges`."""
    return f"portrait-{case}-{variant.name}"


def approach(case: int, variant: Variant) -> str:
    """Return the name of the study of an entry's sections before it has settled."""
    return f"approach-{case}-{variant.name}"


def settled(case: int, variant: Variant) -> str:
    """Return the name of the study of an entry's settled sections, from several starts."""
    return f"settled-{case}-{variant.name}"


def diagram(which: int, variant: Variant) -> str:
    """Return the name of the study of an entry of `bifurcation`."""
    return f"diagram-{which}-{variant.name}"


def values(entry: Mapping[str, Any], size: Size) -> list[float]:
    """Return the values [SI] of a diagram's parameter; both ends are among them."""
    setting = entry["parameter"]
    low, high = entry["interval"]
    count = round((high - low) / (STEPS[setting] * size.thinning)) + 1
    return [reported.si(setting, round(float(v), 9)) for v in np.linspace(low, high, count)]


def _scene(variant: Variant | None, parameters: Mapping[str, float]) -> dict[str, Any]:
    chosen = variant.parameters if variant else {}
    return {"preset": reported.document()["scene"], "parameters": {**chosen, **parameters}}


def _simulation(
    scene: Mapping[str, Any], duration: float, channels: tuple[str, ...], step: float = STEP
) -> dict[str, Any]:
    return {
        "kind": "simulate",
        "scene": scene,
        "duration": duration,
        "output_step": step,
        "channels": list(channels),
    }


def _ideal() -> Iterator[Run]:
    for speed in sorted(
        {entry["omega_over_pi"] for entry in reported.document()["response_peaks"]}
    ):
        scene = _scene(None, {"clearance": 0.0, "speed": reported.si("omega_over_pi", speed)})
        yield Run(ideal(speed), _simulation(scene, DURATION, RESPONSE[:3]), 0.3)


def _responses(variant: Variant) -> Iterator[Run]:
    for case, entry in enumerate(reported.document()["response_peaks"]):
        scene = _scene(variant, reported.parameters(entry))
        yield Run(response(case, variant), _simulation(scene, DURATION, RESPONSE), 0.3)


def _load_cases(variant: Variant) -> Iterator[Run]:
    parameters = reported.parameters(reported.document()["adams_comparison"])
    for name, factor in GRAVITIES.items():
        scene = _scene(variant, {**parameters, "gravity_x": gravity() * factor})
        yield Run(load_case(name, variant), _simulation(scene, DURATION, RESPONSE), 0.3)


def _ranges(variant: Variant, size: Size) -> Iterator[Run]:
    """Yield the sweeps over the cases of the phase portraits, each in one window."""
    entries = reported.document()["phase_ranges"]
    (friction,) = {entry["friction"] for entry in entries}
    points = [
        {name: value for name, value in reported.parameters(entry).items() if name != "friction"}
        for entry in entries
    ]
    for window, (first, last) in {"early": size.early, "late": size.late}.items():
        job = {
            "kind": "sweep",
            "scene": _scene(variant, {"friction": friction}),
            "points": points,
            "periods": last,
            "settle": first,
            "channels": [f"{joint}.{quantity}" for joint in JOINTS for quantity in RANGED],
        }
        yield Run(ranges(window, variant), job, 0.012 * last)


def _motions(variant: Variant, size: Size) -> Iterator[Run]:
    """Yield what belongs to phase portraits and sections."""
    for case, entry in enumerate(reported.document()["phase_ranges"]):
        scene = _scene(variant, reported.parameters(entry))
        period = 2.0 / entry["omega_over_pi"]
        shown = _simulation(scene, size.early[1] * period, PATHS, LONG_STEP)
        yield Run(portrait(case, variant), shown, 0.04 * size.early[1])
        sections = {"scene": scene, "observables": list(PATHS)}
        before = {
            "kind": "poincare",
            "settle": size.early[0],
            "record": size.settle - size.early[0],
        }
        yield Run(approach(case, variant), before | sections, 0.006 * size.settle)
        after = {"settle": size.settle, "record": size.record, "members": size.members}
        judged = {
            "kind": "ensemble",
            "indicators": list(INDICATORS),
            "tolerance": size.tolerance,
        }
        total = size.settle + size.record
        yield Run(settled(case, variant), judged | after | sections, 0.02 * total)


def _diagrams(variant: Variant, size: Size) -> Iterator[Run]:
    for which, entry in enumerate(reported.document()["bifurcation"]):
        setting = entry["parameter"]
        chosen = values(entry, size)
        settle, record = size.diagram
        job = {
            "kind": "bifurcation",
            "scene": _scene(variant, reported.parameters(entry)),
            "parameter": reported.SETTINGS[setting][0],
            "values": chosen,
            "settle": settle,
            "record": record,
            "observables": list(PATHS),
            "indicators": list(INDICATORS),
        }
        yield Run(diagram(which, variant), job, 0.001 * len(chosen) * (settle + record))


def kernels(size: Size) -> list[Run]:
    """Return jobs that need hardly any time, and all the kernels that the others need."""
    entry = reported.document()["phase_ranges"][0]
    found: dict[tuple[str, float], Run] = {}
    for variant in (*size.motions, *size.variants):
        job = {
            "kind": "poincare",
            "scene": _scene(variant, reported.parameters(entry)),
            "settle": 0,
            "record": 1,
            "indicators": list(INDICATORS) if variant in size.motions else [],
        }
        found.setdefault(variant.structure, Run(f"kernels-{variant.name}", job, 1.0))
    return list(found.values())
