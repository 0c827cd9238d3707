"""Job documents by name: what `jointplay.Client` submits and `jointplay.run` computes.

A scene is the name of a preset, a scene document, or the path of one.  Every kind takes the
fields of `COMMON` that it has; every other name is a parameter of the scene, in SI units:

>>> from jointplay import jobs
>>> jobs.simulate("pendulum", duration=1.0, mass=2.0, label="heavy")["scene"]
{'preset': 'pendulum', 'parameters': {'mass': 2.0}}
"""

from collections.abc import Mapping, Sequence
from typing import Any, Final

from jointplay.scene_choice import Scene, scene_document, with_parameters

COMMON: Final = frozenset(
    {
        *("tolerance", "accuracy", "method", "step", "formulation", "certificate"),
        *("label", "cache", "expires"),
    }
)
"""Fields that jobs of several kinds have."""

Document = dict[str, Any]
Names = str | Sequence[str]
Values = Mapping[str, Any] | Sequence[float]
"""Values of a parameter: any sequence, or ``{"from", "to", "count", "spacing"}``."""


def simulate(
    scene: Scene,
    *,
    duration: float,
    output_step: float | None = None,
    channels: Names | None = None,
    section: Mapping[str, float] | None = None,
    **given: Any,
) -> Document:
    """One trajectory of ``duration`` [s], from the scene's start.

    Parameters
    ----------
    scene
        The mechanism.
    duration
        Simulated time, s.
    output_step
        Between stored samples, s; default duration/2000.
    channels
        What to store, names or globs; default all.
    section
        ``{"crank_angle": rad}`` of the Poincare sections.
    given
        Fields of `COMMON`, and parameters of the scene.
    """
    fields = {"duration": duration, "output_step": output_step, "channels": _listed(channels)}
    return _document("simulate", scene, fields | {"section": section}, given)


def bifurcation(
    scene: Scene,
    parameter: str,
    values: Values,
    *,
    settle: int | str | None = None,
    record: int | None = None,
    section: Mapping[str, Any] | None = None,
    observables: Names | None = None,
    indicators: Names | None = None,
    continuation: str | None = None,
    chains: int | None = None,
    **given: Any,
) -> Document:
    """Poincare sections over the values of one parameter: a bifurcation diagram.

    Parameters
    ----------
    scene, given
        As for `simulate`.
    parameter, values
        What differs from point to point.
    settle, record
        Periods before the first section (or ``"auto"``), and sections kept.
    section
        Where: ``{"crank_angle"}``, ``{"onset"}``, or ``{"channel", "value", "direction"}``.
    observables
        Channels taken at the sections.
    indicators
        Of "lyapunov", "zero_one", "recurrence", "rotation", "spectrum", or "all".
    continuation, chains
        "none", "forward", "backward" or "both", and the segments it is cut into.
    """
    fields = {"parameter": parameter, "values": _values(values)}
    fields |= {"continuation": continuation, "chains": chains}
    fields |= _of_sections(settle, record, section, observables, indicators)
    return _document("bifurcation", scene, fields, given)


def sweep(
    scene: Scene,
    grid: Mapping[str, Values] | None = None,
    *,
    points: Sequence[Mapping[str, float]] | None = None,
    duration: float | None = None,
    periods: float | None = None,
    settle: float | None = None,
    channels: Names | None = None,
    statistics: Names | None = None,
    samples_per_period: int | None = None,
    **given: Any,
) -> Document:
    """Signed extremes of channels over every combination of values, or at given points.

    Parameters
    ----------
    scene, given
        As for `simulate`.
    grid
        Values by parameter.
    points
        Values of the parameters at each point, in place of a grid.
    duration, periods
        How long each point runs: s, or periods of its drivers.
    settle
        What of that does not count, in the same unit.
    channels
        Whose extremes and statistics are kept, names or globs.
    statistics, samples_per_period
        Beside the extremes: "mean", "root_mean_square", "contact_share" and others, of so many
        samples in a period.
    """
    fields = {
        "grid": None if grid is None else {name: _values(one) for name, one in grid.items()},
        "points": None if points is None else [dict(point) for point in points],
        "duration": duration,
        "periods": periods,
        "settle": settle,
        "channels": _listed(channels),
        "statistics": _listed(statistics),
        "samples_per_period": samples_per_period,
    }
    return _document("sweep", scene, fields, given)


def poincare(
    scene: Scene,
    *,
    settle: int | str | None = None,
    record: int | None = None,
    section: Mapping[str, Any] | None = None,
    observables: Names | None = None,
    indicators: Names | None = None,
    **given: Any,
) -> Document:
    """Poincare sections of one trajectory over many periods; fields as of `bifurcation`."""
    fields = _of_sections(settle, record, section, observables, indicators)
    return _document("poincare", scene, fields, given)


def ensemble(
    scene: Scene,
    members: int,
    *,
    spread: float | None = None,
    seed: int | None = None,
    settle: int | str | None = None,
    record: int | None = None,
    section: Mapping[str, Any] | None = None,
    observables: Names | None = None,
    indicators: Names | None = None,
    **given: Any,
) -> Document:
    """Poincare sections of many starts that differ by a perturbation; else as `bifurcation`.

    Parameters
    ----------
    scene, given, settle, record, section, observables, indicators
        As for `bifurcation`.
    members
        Number of starts; the first is not perturbed.
    spread, seed
        Standard deviation of the perturbation relative to the finest clearance, and its seed.
    """
    fields = {"members": members, "spread": spread, "seed": seed}
    fields |= _of_sections(settle, record, section, observables, indicators)
    return _document("ensemble", scene, fields, given)


def accuracy_study(
    scene: Scene,
    *,
    duration: float | None = None,
    methods: Names | None = None,
    tolerances: Sequence[float] | None = None,
    **given: Any,
) -> Document:
    """Costs and errors of every method and tolerance, against a reference run.

    Parameters
    ----------
    scene, given
        As for `simulate`, but no tolerance, accuracy, method or step.
    duration
        Simulated time, s; default one period of the drivers.
    methods, tolerances
        Those to measure; default all.
    """
    fields = {"duration": duration, "methods": _listed(methods)}
    fields |= {"tolerances": None if tolerances is None else _values(tolerances)}
    return _document("accuracy-study", scene, fields, given)


def _document(
    kind: str, scene: Scene, fields: Mapping[str, Any], given: Mapping[str, Any]
) -> Document:
    common = {name: value for name, value in given.items() if name in COMMON}
    values = {name: _plain(value) for name, value in given.items() if name not in COMMON}
    told = {name: value for name, value in {**fields, **common}.items() if value is not None}
    return {"kind": kind, "scene": with_parameters(scene_document(scene), values), **told}


def _of_sections(
    settle: int | str | None,
    record: int | None,
    section: Mapping[str, Any] | None,
    observables: Names | None,
    indicators: Names | None,
) -> Document:
    return {
        "settle": settle,
        "record": record,
        "section": None if section is None else dict(section),
        "observables": _listed(observables),
        "indicators": "all" if indicators == "all" else _listed(indicators),
    }


def _listed(names: Names | None) -> list[str] | None:
    if names is None:
        return None
    return [names] if isinstance(names, str) else list(names)


def _values(values: Values) -> Any:
    return dict(values) if isinstance(values, Mapping) else [_plain(value) for value in values]


def _plain(value: Any) -> Any:
    """Return a number of numpy as Python's, which JSON takes."""
    return value.item() if hasattr(value, "item") else value
