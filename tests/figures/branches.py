"""A fold as a continuation has it: stable above, unstable below, found from its upper end."""

from dataclasses import replace

import numpy as np

from jointplay.records.channel import Channel
from jointplay.records.point import PointStatus
from jointplay.records.study import StudyDataset

HEIGHTS = np.array([2.0, 1.0, 0.0, -1.0, -2.0])
"""m; the parameter is their square, less one."""
REAL = np.array([0.2, 0.5, 1.0, 1.5, 4.0])
"""Real parts of the first multiplier."""
NOTE = "the orbits meet"


def over_two_parameters() -> StudyDataset:
    """Return the branch of `folded`, and the curve of its fold with a cusp in the middle."""
    found, heights = folded(), HEIGHTS
    columns = {
        "value": heights**3,
        "label": np.array([3.0, 0.0, 4.0, 0.0, 1.0]),
        "bound": np.zeros(5),
        "length": np.array([0.0, 1.0, 2.0, -1.0, -2.0]),
        "unstable": np.zeros(5),
        "state.mass.s": heights,
    }
    values = {
        name: np.array([rows[0], columns.get(name, rows[0])])
        for name, rows in found.section_values.items()
    }
    values["second"] = np.array([np.full(5, 4.0), heights**2])
    values["second_bound"] = np.zeros((2, 5))
    more = tuple(Channel(name, "m", name) for name in ("second", "second_bound"))
    return replace(
        found,
        attributes=found.attributes | {"labels": found.attributes["labels"] | {"CP": "cusp"}},
        parameters=(*found.parameters, Channel("width", "m", "width")),
        values=np.zeros((2, 2)),
        status=np.array([PointStatus.done] * 2, np.uint8),
        observables=(*found.observables, *more),
        times=np.array([np.arange(5.0)] * 2),
        section_values=values,
    )


def folded() -> StudyDataset:
    """Return a branch of five orbits, and one that has none."""
    zero = np.zeros(5)
    columns = {
        "value": HEIGHTS**2 - 1.0,
        "label": np.array([1.0, 0.0, 3.0, 0.0, 2.0]),
        "bound": np.array([0.0, 0.0, 1e-6, 0.0, 0.0]),
        "length": 2.0 - HEIGHTS,
        "unstable": np.array([0.0, 0.0, 0.0, 1.0, 1.0]),
        "state.mass.s": HEIGHTS,
        "multiplier_1.real": REAL,
        "multiplier_1.imaginary": np.where(HEIGHTS > 0.0, 0.3, 0.0),
        "multiplier_2.real": 0.5 * REAL,
        "multiplier_2.imaginary": np.where(HEIGHTS > 0.0, -0.3, 0.0),
    }
    special = [{"row": 2, "note": NOTE}, {"row": 4, "note": "lost here"}]
    return StudyDataset(
        attributes={
            "job": {"kind": "continuation"},
            "scene": {"name": "fold", "bodies": {}, "joints": {}},
            "labels": {"": "orbit", "EP": "end", "MX": "lost", "LP": "fold"},
        },
        parameters=(Channel("speed", "rad/s", "speed"),),
        values=np.zeros((2, 1)),
        status=np.array([PointStatus.done, PointStatus.failed], np.uint8),
        observables=tuple(
            Channel(name, "m" if name.startswith("state") else "1", name) for name in columns
        ),
        times=np.array([np.arange(5.0), zero + np.nan]),
        section_values={name: np.array([one, zero + np.nan]) for name, one in columns.items()},
        documents={0: {"special": special}},
    )
