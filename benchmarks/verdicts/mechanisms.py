"""The mechanisms of random points: their jobs, and their motions by an independent program."""

import math
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from benchmarks.verdicts import independent
from jointplay.records.arrays import Flags, Floats
from jointplay.solver.scene import presets


class Mechanism(Protocol):
    """A mechanism with two parameters and their ranges."""

    @property
    def ranges(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Lowest and highest value of each parameter."""

    @property
    def observables(self) -> tuple[str, str]:
        """Channels that the independent program computes, too."""

    def scene(self, values: Floats) -> dict[str, Any]:
        """Return the scene at a point."""

    def motion(self, values: Floats, section: Floats, periods: int) -> tuple[Floats, Floats]:
        """Return what the independent program makes of it, from a section on."""

    def scales(self, values: Floats) -> Floats:
        """Return what counts as one in each observable: a link or the clearance, and its rate."""

    def apart(self, sections: Floats) -> Flags:
        """Return (sections,) at which nothing touches: from there the program can go on."""


@dataclass(frozen=True)
class Pendulum:
    """theta'' = g w0^2 cos(2 pi t) - b theta' - w0^2 sin(theta), w0 = 3 pi (Taylor 2005, 12.4)."""

    ranges: tuple[tuple[float, float], tuple[float, float]] = ((0.9, 1.5), (3.0, 8.0))
    observables: tuple[str, str] = ("rod.theta", "rod.omega")
    weight: float = (3.0 * math.pi) ** 2

    def scene(self, values: Floats) -> dict[str, Any]:
        """See `Mechanism`."""
        ends = {"first": "ground.O", "second": "rod.pivot"}
        course = {
            "type": "sinusoidal",
            "amplitude": 1.0,
            "frequency": 2.0 * math.pi,
            "phase": math.pi / 2.0,
        }
        moment = float(values[0]) * self.weight
        return {
            "name": "driven-pendulum-with-drag",
            "gravity": [self.weight, 0.0],
            "ground": {"points": {"O": [0.0, 0.0]}},
            "bodies": {"rod": {"mass": 1.0, "inertia": 1e-12, "points": {"pivot": [-1.0, 0.0]}}},
            "joints": {
                "pivot": {"type": "revolute", "bearing": "ground.O", "journal": "rod.pivot"}
            },
            "forces": {
                "push": {"type": "torque", **ends, "moment": moment, "course": course},
                "drag": {"type": "torsion-spring", **ends, "damping": float(values[1])},
            },
        }

    def motion(self, values: Floats, section: Floats, periods: int) -> tuple[Floats, Floats]:
        """See `Mechanism`."""
        moment, damping = values[0] * self.weight, values[1]
        numbers = (damping, self.weight, moment, 2.0 * math.pi)
        found: tuple[Floats, Floats] = independent.pendulum(
            section[0], section[1], numbers, periods
        )
        return found

    def scales(self, values: Floats) -> Floats:
        """See `Mechanism`."""
        return np.array([1.0, 2.0 * math.pi])

    def apart(self, sections: Floats) -> Flags:
        """See `Mechanism`."""
        return np.ones(len(sections), np.bool_)


@dataclass(frozen=True)
class Oscillator:
    """The preset impact-oscillator over speed and amplitude: grazing, folds and doublings."""

    ranges: tuple[tuple[float, float], tuple[float, float]] = ((15.0, 35.0), (2e-3, 8e-3))
    observables: tuple[str, str] = ("mass.x", "mass.vx")
    gap: float = 0.01

    def scene(self, values: Floats) -> dict[str, Any]:
        """See `Mechanism`."""
        return _preset("impact-oscillator", speed=values[0], amplitude=values[1])

    def motion(self, values: Floats, section: Floats, periods: int) -> tuple[Floats, Floats]:
        """See `Mechanism`."""
        speed, radius = values
        numbers = (400.0, 2.0, radius, speed, self.gap, 1e9, 0.75 * (1.0 - 0.8**2))
        position, rate = section
        sections, growth = independent.oscillator(position + self.gap, rate, numbers, periods)
        return sections - np.array([self.gap, 0.0]), growth

    def scales(self, values: Floats) -> Floats:
        """See `Mechanism`."""
        return np.array([0.2, 0.2 * values[0]])

    def apart(self, sections: Floats) -> Flags:
        """See `Mechanism`."""
        return np.asarray(sections[:, 0] < 0.0, np.bool_)


@dataclass(frozen=True)
class SliderCrank:
    """The preset slider-crank over clearance and speed; no program but the solver integrates it."""

    ranges: tuple[tuple[float, float], tuple[float, float]] = ((5e-5, 5e-4), (100.0, 520.0))

    def scene(self, values: Floats) -> dict[str, Any]:
        """Return the scene at a point."""
        return _preset("slider-crank", clearance=values[0], speed=values[1])


def _preset(name: str, **values: float) -> dict[str, Any]:
    assert name in presets.names()
    return {"preset": name, "parameters": {key: float(value) for key, value in values.items()}}
