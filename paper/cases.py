"""Jobs of the reproduction, in every printed setting and reading, and the stores they give."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import Any, Final

import numpy as np

from jointplay.paper import reported
from jointplay.paper.variants import Size, Variant
from jointplay.solver.scene import presets
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.studies.reader import StudyReader

DURATION: Final = 2.0
"""Duration of responses, s: one revolution at the slowest speed that was published."""
STEP: Final = 1e-4
"""Between samples, s: half of the publication's, and smooth enough for paths."""
LONG_STEP: Final = 2e-4
"""The same over many revolutions."""
JOINTS: Final = ("A", "B")
"""The press's joints with clearance."""
INDICATORS: Final = ("lyapunov", "zero_one", "recurrence", "rotation")
PATHS: Final = tuple(
    f"{joint}.eccentricity{rate}_{axis}"
    for joint in JOINTS
    for rate in ("", "_rate")
    for axis in "xy"
)
RANGED: Final = tuple(name for name in PATHS if name.endswith("x"))
OUTPUT: Final = ("displacement", "velocity", "acceleration")
RESPONSE: Final = (*OUTPUT, "*.normal_force", "*.eccentricity_[xy]")
GRAVITIES: Final = {"forward": 1.0, "reversed": -1.0, "absent": 0.0}
"""Load cases of the comparison with another program: multiples of the scene's gravity."""
STEPS: Final = {"clearance_mm": 0.005, "omega_over_pi": 0.01}
"""Between values of a diagram, in the unit of the setting: half the publication's or finer."""


@dataclass(frozen=True)
class Run:
    """One job and its number among the results; `weight` is about its seconds on one core."""

    name: str
    job: dict[str, Any]
    weight: float


def name(kind: str, which: object, variant: Variant | None = None) -> str:
    """Return the name of a run, and of the one file of its results.

    Parameters
    ----------
    kind
        ``ideal`` (which: speed over π), ``response`` (entry of `response_peaks`), ``gravity`` (name
        in `GRAVITIES`), ``ranges`` (window ``early`` or ``late``), ``diagram`` (entry of
        `bifurcation`); of an entry of `phase_ranges`, ``portrait`` (trajectory), ``approach``
        (sections before it has settled) and ``settled`` (sections afterwards, from several starts).
    """
    return "-".join([kind, str(which), *([variant.name] if variant else [])]) + ".zarr.zip"


def runs(size: Size) -> list[Run]:
    """Return all jobs of a reproduction."""
    printed = reported.document()
    found = []
    for speed in sorted({entry["omega_over_pi"] for entry in printed["response_peaks"]}):
        scene = _scene(None, {"clearance": 0.0, "speed": reported.si("omega_over_pi", speed)})
        found.append(Run(name("ideal", f"{speed:g}pi"), _simulation(scene, channels=OUTPUT), 0.3))
    for variant in size.variants:
        found += [*_responses(variant), *_load_cases(variant), *_ranges(variant, size)]
    for variant in size.motions:
        found += [*_motions(variant, size), *_diagrams(variant, size)]
    return found


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
    scene: Mapping[str, Any],
    duration: float = DURATION,
    channels: tuple[str, ...] = RESPONSE,
    step: float = STEP,
) -> dict[str, Any]:
    return {
        "kind": "simulate",
        "scene": scene,
        "duration": duration,
        "output_step": step,
        "channels": list(channels),
    }


def _responses(variant: Variant) -> Iterator[Run]:
    for case, entry in enumerate(reported.document()["response_peaks"]):
        scene = _scene(variant, reported.parameters(entry))
        yield Run(name("response", case, variant), _simulation(scene), 0.3)


def _load_cases(variant: Variant) -> Iterator[Run]:
    printed = reported.document()
    own = float(presets.document(printed["scene"])["parameters"]["gravity_x"]["default"])
    parameters = reported.parameters(printed["adams_comparison"])
    for gravity, factor in GRAVITIES.items():
        scene = _scene(variant, {**parameters, "gravity_x": own * factor})
        yield Run(name("gravity", gravity, variant), _simulation(scene), 0.3)


def _ranges(variant: Variant, size: Size) -> Iterator[Run]:
    """Yield the sweeps over the cases of the phase portraits, each in one window."""
    points = [reported.parameters(entry) for entry in reported.document()["phase_ranges"]]
    (friction,) = {point.pop("friction") for point in points}
    for window, (first, last) in {"early": size.early, "late": size.late}.items():
        job = {
            "kind": "sweep",
            "scene": _scene(variant, {"friction": friction}),
            "points": points,
            "periods": last,
            "settle": first,
            "channels": list(RANGED),
        }
        yield Run(name("ranges", window, variant), job, 0.012 * last)


def _motions(variant: Variant, size: Size) -> Iterator[Run]:
    """Yield what belongs to phase portraits and sections."""
    for case, entry in enumerate(reported.document()["phase_ranges"]):
        scene = _scene(variant, reported.parameters(entry))
        named = partial(name, which=case, variant=variant)
        first, last = size.early
        shown = _simulation(scene, last * 2.0 / entry["omega_over_pi"], PATHS, LONG_STEP)
        yield Run(named("portrait"), shown, 0.04 * last)
        sections = {"scene": scene, "observables": list(PATHS)}
        before = {"kind": "poincare", "settle": first, "record": size.settle - first}
        yield Run(named("approach"), before | sections, 0.006 * size.settle)
        after = {
            "kind": "ensemble",
            "indicators": list(INDICATORS),
            "tolerance": size.tolerance,
            "settle": size.settle,
            "record": size.record,
            "members": size.members,
        }
        yield Run(named("settled"), after | sections, 0.02 * (size.settle + size.record))


def _diagrams(variant: Variant, size: Size) -> Iterator[Run]:
    for which, entry in enumerate(reported.document()["bifurcation"]):
        chosen = values(entry, size)
        settle, record = size.diagram
        job = {
            "kind": "bifurcation",
            "scene": _scene(variant, reported.parameters(entry)),
            "parameter": reported.SETTINGS[entry["parameter"]][0],
            "values": chosen,
            "settle": settle,
            "record": record,
            "observables": list(PATHS),
            "indicators": list(INDICATORS),
        }
        weight = 0.001 * len(chosen) * (settle + record)
        yield Run(name("diagram", which, variant), job, weight)


class Stores:
    """Readers of the stores of a reproduction in a folder, by the words of `name`."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._run, self._study = cache(ResultReader), cache(StudyReader)

    def path(self, kind: str, which: object, variant: Variant | None = None) -> Path:
        """Return the file of a store."""
        return self._folder / name(kind, which, variant)

    def run(self, kind: str, which: object, variant: Variant | None = None) -> ResultReader:
        """Open the results of a simulation, once."""
        return self._run(self.path(kind, which, variant))

    def study(self, kind: str, which: object, variant: Variant) -> StudyReader:
        """Open the results of a study, once."""
        return self._study(self.path(kind, which, variant))
