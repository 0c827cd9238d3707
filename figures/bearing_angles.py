"""Loads on a bearing by their direction in it: mean and largest force of each sector."""

from typing import NamedTuple

import numpy as np

from jointplay.figures import sampling, scene_facts
from jointplay.figures.kind import Selection
from jointplay.records.arrays import Flags, Floats
from jointplay.records.run import Source, inside

_FEW_INSTANTS = 3
"""Contacts of fewer instants are taken from the list of contacts, not from forces."""


class Loads(NamedTuple):
    """(n + 1,) edges of sectors [rad]; (n,) mean over all time, and largest force [N], in them."""

    edges: Floats
    mean: Floats
    largest: Floats


def channels(source: Source, joint: str) -> tuple[str, ...]:
    """Name the channels that the loads on a bearing are found from."""
    names = (*_centre(joint), f"{joint}.normal_force")
    rates = sampling.stored_rates(source, _centre(joint))
    body = _bearing_body(source, joint)
    return (*names, *rates, *(() if body == "ground" else (f"{body}.theta",)))


def loads(source: Source, joint: str, selection: Selection, sectors: int) -> Loads:
    """Sum up a journal's loads in a window of time by their angle in the bearing's body.

    Forces count for their share of the time, at every step of the trajectory or at samples where
    steps are not kept. A contact that holds fewer than three of these instants counts with its
    impulse and its peak force, at the angle where it began; the journal's path is interpolated.
    """
    time, values = sampling.whole(source, channels(source, joint), selection)
    force = np.nan_to_num(values[f"{joint}.normal_force"])
    whole = float(time[-1] - time[0])
    shares = np.gradient(time) if len(time) > 1 else np.zeros(1)
    shares[[0, -1]] *= 0.5
    rows = sampling.impacts_of(source, joint)
    rows = rows[inside(rows["onset"], time[0], time[-1])]
    first, behind = (np.searchsorted(time, rows[name]) for name in ("onset", "release"))
    short = rows[behind - first < _FEW_INSTANTS]
    sampled = ~_during(time, short["onset"], short["release"]) & (force > 0.0)
    moments = np.concatenate([time[sampled], short["onset"]])
    impulses = np.concatenate([(force * shares)[sampled], short["impulse"]])
    peaks = np.concatenate([force[sampled], short["peak_force"]])
    edges = np.linspace(0.0, 2.0 * np.pi, sectors + 1)
    angles = _angles(source, joint, moments, time, values) % (2.0 * np.pi)
    known = np.isfinite(angles)
    angles, impulses, peaks = angles[known], impulses[known], peaks[known]
    sector = np.minimum((angles / (2.0 * np.pi) * sectors).astype(np.int64), sectors - 1)
    largest = np.zeros(sectors)
    np.maximum.at(largest, sector, peaks)
    mean = np.bincount(sector, impulses, sectors) / (whole or 1.0)
    return Loads(edges, mean, largest)


def _angles(
    source: Source, joint: str, moments: Floats, time: Floats, values: dict[str, Floats]
) -> Floats:
    """Give the angles [rad] of a journal's centre in the bearing's body, at some moments [s]."""
    rates = sampling.stored_rates(source, _centre(joint)) or (None, None)
    x, y = (
        sampling.interpolated(moments, time, values[name], values[rate] if rate else None)
        for name, rate in zip(_centre(joint), rates, strict=True)
    )
    body = _bearing_body(source, joint)
    turned = 0.0 if body == "ground" else np.interp(moments, time, values[f"{body}.theta"])
    return np.asarray(np.arctan2(y, x) - turned)


def _during(time: Floats, begins: Floats, ends: Floats) -> Flags:
    """Tell which times lie in one of some spans that do not overlap."""
    order = np.argsort(begins)
    begins, ends = begins[order], ends[order]
    before = np.searchsorted(begins, time, side="right") - 1
    return (before >= 0) & (time <= ends[np.maximum(before, 0)]) if len(begins) else time < -np.inf


def _centre(joint: str) -> tuple[str, str]:
    return f"{joint}.eccentricity_x", f"{joint}.eccentricity_y"


def _bearing_body(source: Source, joint: str) -> str:
    bearing: str = scene_facts.scene(source)["joints"][joint]["bearing"]
    return bearing.partition(".")[0]
