"""Where parameters may move: bounds, and coordinates from 0 to 1 in which all count alike."""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product

import numpy as np

from jointplay.records.arrays import Flags, Floats
from jointplay.records.failure import Problem
from jointplay.records.suggestions import unknown
from jointplay.solver.calibration.document import FreeParameter
from jointplay.solver.quantities.scalars import power
from jointplay.solver.scene.document import Parameter, Scene
from jointplay.solver.scene.parameters import allowed_range

SIGNIFICANT = 4
"""Digits of a parameter that is handed out."""


@dataclass(frozen=True, eq=False)
class Space:
    """The box of the parameters that move.

    Attributes
    ----------
    names : tuple of str
        Of the parameters.
    minimum, maximum : (parameters,) float
        In the unit of each.
    logarithmic : (parameters,) bool
        Whether equal ratios count the same.
    """

    names: tuple[str, ...]
    minimum: Floats
    maximum: Floats
    logarithmic: Flags

    def values(self, unit: Floats) -> Floats:
        """Return parameters (n, parameters) at coordinates from 0 to 1; the ends are exact."""
        share = np.clip(unit, 0.0, 1.0)
        linear = self.minimum + share * (self.maximum - self.minimum)
        ratio = np.where(self.logarithmic, self.maximum, 1.0)
        ratio = ratio / np.where(self.logarithmic, self.minimum, 1.0)
        found = np.where(self.logarithmic, self.minimum * power(ratio, share), linear)
        found = np.where(share == 1.0, self.maximum, found)
        return np.asarray(np.clip(found, self.minimum, self.maximum), np.float64)

    def rounded(self, values: Floats) -> Floats:
        """Return parameters (parameters,) with few digits, still inside the bounds."""
        short = np.array([float(f"{value:.{SIGNIFICANT}g}") for value in values])
        return np.asarray(np.clip(short, self.minimum, self.maximum), np.float64)

    def corners(self) -> list[dict[str, float]]:
        """Return the parameters at every corner of the box."""
        ends = zip(self.minimum.tolist(), self.maximum.tolist(), strict=True)
        return [dict(zip(self.names, corner, strict=True)) for corner in product(*ends)]


def space_of(parameters: Mapping[str, FreeParameter]) -> Space:
    """Return the box that a document describes."""
    bounds = np.array([[free.minimum, free.maximum] for free in parameters.values()])
    logarithmic = np.array([free.spacing == "log" for free in parameters.values()])
    return Space(tuple(parameters), bounds[:, 0], bounds[:, 1], logarithmic)


def space_problems(parameters: Mapping[str, FreeParameter], scene: Scene) -> list[Problem]:
    """Return what is wrong with the parameters that are to move."""
    problems = []
    for name, free in parameters.items():
        pointer = f"/parameters/{name}"
        declared = scene.parameters.get(name)
        if declared is None:
            problems.append(Problem(pointer, unknown("parameter", name, scene.parameters)))
        elif declared.choices is not None:
            sentence = (
                f"'{name}' is one of {', '.join(declared.choices)}; only a parameter whose values"
                " are numbers can move. Set it in the scene or in the cases instead."
            )
            problems.append(Problem(pointer, sentence))
        else:
            problems += _bounds_problems(pointer, name, free, declared)
    return problems


def _bounds_problems(
    pointer: str, name: str, free: FreeParameter, declared: Parameter
) -> list[Problem]:
    if not free.minimum < free.maximum:
        sentence = (
            f"The minimum {free.minimum:g} is not below the maximum {free.maximum:g}; a parameter"
            " that shall not move belongs in the scene's parameters."
        )
        return [Problem(f"{pointer}/minimum", sentence)]
    low = -np.inf if declared.minimum is None else declared.minimum
    high = np.inf if declared.maximum is None else declared.maximum
    problems = [
        Problem(f"{pointer}/{end}", f"'{name}' is {value:g} here; it {allowed_range(declared)}.")
        for end, value in (("minimum", free.minimum), ("maximum", free.maximum))
        if not low <= value <= high
    ]
    if free.spacing == "log" and not free.minimum > 0.0:
        sentence = f"Equal ratios do not begin at {free.minimum:g}; with 'log' give one above zero."
        problems.append(Problem(f"{pointer}/spacing", sentence))
    return problems
