"""A run that is known in closed form, to draw: a made-up machine with two clearance joints."""

from typing import Any, NamedTuple

import numpy as np

from jointplay.records.channel import Channel
from jointplay.records.impact import IMPACT
from jointplay.records.peak import Peak
from jointplay.records.run import Dataset

CLEARANCES = {"left": 5e-4, "right": 2e-4}
SCENE = {
    "name": "rocker",
    "gravity": [0.0, -9.81],
    "ground": {"points": {"O": [0.0, 0.0], "Q": [0.4, 0.0]}},
    "bodies": {
        "crank": {"mass": 1.0, "inertia": 0.1, "points": {"O": [-0.1, 0.0], "pin": [0.1, 0.0]}},
        "plate": {
            "mass": 1.0,
            "inertia": 0.1,
            "points": {"pin": [-0.2, 0.0], "tip": [0.0, 0.15], "end": [0.2, 0.0]},
        },
        "block": {"mass": 1.0, "inertia": 0.1, "points": {"end": [0.0, 0.0]}},
        "foot": {"mass": 1.0, "inertia": 0.1, "points": {"end": [0.0, 0.0], "toe": [0.0, -0.1]}},
    },
    "joints": {
        "O": {"type": "revolute", "bearing": "ground.O", "journal": "crank.O", "clearance": None},
        "left": {
            "type": "revolute",
            "bearing": "crank.pin",
            "journal": "plate.pin",
            "clearance": {"radial_clearance": CLEARANCES["left"], "bearing_radius": 0.01},
        },
        "right": {
            "type": "revolute",
            "bearing": "plate.end",
            "journal": "block.end",
            "clearance": {"radial_clearance": CLEARANCES["right"], "bearing_radius": 0.01},
        },
        "closed": {
            "type": "revolute",
            "bearing": "plate.end",
            "journal": "block.end",
            "clearance": {"radial_clearance": 0.0, "bearing_radius": 0.01},
        },
        "weld": {"type": "fixed", "base": "block.end", "part": "foot.end", "angle": 0.0},
        "guide": {
            "type": "prismatic",
            "guide": "ground.Q",
            "slider": "block.end",
            "axis": [1.0, 0.2],
        },
    },
    "drivers": {"motor": {"joint": "O", "speed": 1.0}},
    "outputs": [{"name": "stroke", "channel": "block.x"}, {"name": "pace", "channel": "block.vx"}],
}
POSE = {
    "crank": (0.08, 0.06, float(np.arctan2(0.06, 0.08))),
    "plate": (0.36, 0.12, 0.0),
    "block": (0.56, 0.12, 0.2),
    "foot": (0.56, 0.12, 0.2),
}


def closed_form_motion(samples=2001, duration=2.0, periods=40):
    """A stroke, and journals that spiral outwards to the wall of their bearing."""
    channels = []
    values = {}
    time = np.linspace(0.0, duration, samples)
    moments = duration * np.arange(1, periods + 1) / (periods + 1)

    def add(name, unit, function):
        channels.append(Channel(name, unit, f"{name} of the rocker"))
        values[name] = function(time)
        at_sections[name] = function(moments)

    at_sections = {}
    add("block.x", "m", lambda t: 0.56 + 0.2 * np.sin(np.pi * t))
    add("block.vx", "m/s", lambda t: 0.2 * np.pi * np.cos(np.pi * t))
    add("stroke", "m", lambda t: 0.56 + 0.2 * np.sin(np.pi * t))
    add("pace", "m/s", lambda t: 0.2 * np.pi * np.cos(np.pi * t))
    for body, (x, y, angle) in POSE.items():
        if body != "block":
            add(f"{body}.x", "m", lambda t, x=x: np.full_like(t, x))
        add(f"{body}.y", "m", lambda t, y=y: np.full_like(t, y))
        add(f"{body}.theta", "rad", lambda t, angle=angle: np.full_like(t, angle))
    for joint, clearance in CLEARANCES.items():

        def spiral(t, clearance=clearance, quarter=0.0):
            radius = clearance * (1.0 - np.exp(-3.0 * t) * np.cos(9.0 * t))
            return np.minimum(radius, 1.002 * clearance) * np.cos(9.0 * t - quarter)

        def rate(function):
            return lambda t: (function(t + 1e-6) - function(t - 1e-6)) / 2e-6

        for axis, quarter in (("x", 0.0), ("y", np.pi / 2.0)):
            eccentricity = lambda t, f=spiral, q=quarter: f(t, quarter=q)  # noqa: E731
            add(f"{joint}.eccentricity_{axis}", "m", eccentricity)
            add(f"{joint}.eccentricity_rate_{axis}", "m/s", rate(eccentricity))
        add(f"{joint}.normal_force", "N", lambda t: np.maximum(0.0, 60.0 * np.sin(9.0 * t)))
        add(f"{joint}.penetration", "m", lambda t: 2e-6 * np.sin(9.0 * t - 0.2))
    add("motor.power", "W", lambda t: 3.0 + 0.0 * t)
    add("energy.kinetic", "J", lambda t: 1.0 + np.sin(np.pi * t))
    add("energy.potential", "J", lambda t: 5.0 * t)
    return Dataset(
        attributes={"scene": SCENE},
        channels=channels,
        time=time,
        values=values,
        section_time=moments,
        section_values=at_sections,
        extremes={
            name: Peak(*(float(x) for x in (v.min(), time[v.argmin()], v.max(), time[v.argmax()])))
            for name, v in values.items()
        },
        contacts=_impacts(duration),
        joints=tuple(CLEARANCES),
        certified=_certified(duration, len(channels)),
    )


class Numbers(NamedTuple):
    values: Any


class Certified(NamedTuple):
    attributes: Any
    arrays: Any


def _certified(duration, channels):
    """Errors that grow a thousandfold until half of the run, where the motion is lost for good."""
    time = duration * np.arange(129) / 128.0
    error = 1e-5 * np.exp(np.minimum(6.9 * time / (0.5 * duration), 6.9))
    arrays = {"time": time, "error": np.repeat(error[:, None], channels, axis=1)}
    attributes = {"horizon": 0.5 * duration, "converged": [[0.0, 0.5 * duration]]}
    return Certified(attributes, {name: Numbers(values) for name, values in arrays.items()})


def _impacts(duration):
    """Sixty that samples step over, and at each joint one that lasts, which is the strongest."""
    impacts = np.zeros(62, IMPACT)
    impacts["joint"] = np.arange(62) % 2
    impacts["onset"] = duration * (np.arange(62) / 62.0) ** 2
    impacts["release"] = impacts["onset"] + 2e-5
    impacts["peak_force"] = 400.0 * np.exp(-np.arange(62) / 20.0)
    impacts["impulse"] = 1e-5 * impacts["peak_force"]
    impacts["onset"][60:], impacts["release"][60:] = 0.0, np.pi / 9.0
    impacts["peak_force"][60:] = 500.0
    return impacts
