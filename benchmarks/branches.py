"""Branches of slider-crank, four-bar and press, each special orbit beside motions on both sides.

A motion begins next to an orbit of the branch and is only simulated: it must come back where all
multipliers are inside the circle, and leave where one is not; beyond a fold it must leave.
"""

import argparse
import time
from typing import Any

import numpy as np

from jointplay.local import run
from jointplay.records.arrays import Floats
from jointplay.records.branch import Branch, branches
from jointplay.solver.continuation.passage import Section
from jointplay.solver.continuation.plan import ContinuationStudy
from jointplay.solver.continuation.run import section_map
from jointplay.solver.continuation.section_map import SectionMap
from jointplay.solver.continuation.settled import Settled
from jointplay.solver.continuation.start import scaled
from jointplay.solver.kinds import admit

Case = tuple[str, dict[str, float], dict[str, Any]]
ROUGH = {"restitution": 0.5, "friction": 0.1}
CASES: dict[str, Case] = {
    "slider-crank-speed": (
        "slider-crank",
        ROUGH | {"clearance": 1e-4},
        {"parameter": "speed", "values": {"from": 300.0, "to": 160.0, "count": 60}},
    ),
    "slider-crank-clearance": (
        "slider-crank",
        ROUGH | {"speed": 300.0},
        {"parameter": "clearance", "values": {"from": 1e-4, "to": 2e-4, "count": 150}},
    ),
    # where a continuation in steps of speed had been lost at 156.03, which no event explained
    "slider-crank-lost": (
        "slider-crank",
        {"restitution": 0.46, "friction": 0.1, "clearance": 2e-4},
        {
            "parameter": "speed",
            "values": {"from": 160.0, "to": 155.0, "count": 80},
            "state": [0.17019336, -5.2787385e-4, -0.058574642, -67.962673, 0.0044],
        },
    ),
    "four-bar-speed": (
        "four-bar",
        {"restitution": 0.5},
        {
            "parameter": "speed",
            "values": {"from": 45.0, "to": 33.0, "count": 60},
            "tolerance": 1e-12,
        },
    ),
    "four-bar-clearance": (
        "four-bar",
        {"restitution": 0.5},
        {
            "parameter": "clearance",
            "values": {"from": 5e-4, "to": 4e-4, "count": 30},
        },
    ),
    "press-speed": (
        "seven-bar-press-fitted",
        ROUGH,
        {"parameter": "speed", "values": {"from": 3.0, "to": 4.0, "count": 30}},
    ),
    "press-clearance": (
        "seven-bar-press-fitted",
        ROUGH,
        {"parameter": "clearance", "values": {"from": 5e-4, "to": 4.9e-4, "count": 20}},
    ),
}
PERIODS = 240
LONGEST = 16
"""Period of a motion at most, to be found."""
NUDGE, BACK, GONE = 1e-6, 0.5, 2.0
"""Start beside an orbit, in the scales of its states; shares at which it is back or has gone of how
far it is away after the first periods, `SOON`."""
SOON = 3
STRONG = 1e-2
"""Share of its start beside the orbit that counts as there, after the first periods: below, all is
the orbit's own error."""
OPEN = 0.02
"""Distance of multipliers from the circle at which a motion shows in time what they do."""
BEYOND = 1e-4
"""Beyond a fold, in the range."""


def motion(map_: SectionMap, section: Section) -> tuple[Floats, int]:
    """Return where a motion is after each period, (periods + 1, states), and its last impacts."""
    states, onsets = [section.state], 0
    for count in range(PERIODS):
        (passage,) = map_.passages([Section(section.value, states[-1])])
        states.append(passage.end)
        onsets += passage.onsets * (count >= PERIODS - LONGEST)
    return np.array(states)[:, : map_.kernel.states], onsets


def period_of(states: Floats, scales: Floats) -> int:
    """Return the period of a motion at its end; 0: none up to `LONGEST`."""
    tail = states[-3 * LONGEST :] / scales
    for period in range(1, LONGEST + 1):
        if float(np.abs(tail[period:] - tail[:-period]).max()) < 1e-3:
            return period
    return 0


def shown(map_: SectionMap, branch: Branch, row: int, value: float) -> str:
    """Return what a motion that begins next to an orbit does, at a value of the parameter."""
    names = ("state.", "rate.", "impact_rate.")
    state = np.array([v[row] for c, v in branch.columns.items() if c.name.startswith(names)])
    count = map_.kernel.states
    nudged = state.copy()
    nudged[:count] += NUDGE * map_.scales[:count]
    states, onsets = motion(map_, Section(value, nudged))
    away = np.abs((states - state[:count]) / map_.scales[:count]).max(axis=1)
    soon = max(float(away[SOON]), STRONG * NUDGE)
    comes = "returns" if away[-1] < BACK * soon else "stays near"
    comes = "leaves" if away[SOON:].max() > GONE * soon else comes
    period = period_of(states, map_.scales[:count])
    return f"{comes} (then period {period or 'none'}, {onsets / LONGEST:.3g} impacts a turn)"


def beside(branch: Branch, row: int, step: int) -> int:
    """Return the next orbit on one side of a special one whose multipliers tell it apart."""
    label, count = branch.column("label"), len(branch.column("label"))
    largest = np.hypot(branch.column("multiplier_1.real"), branch.column("multiplier_1.imaginary"))
    found = row + step
    while 0 < found < count - 1 and (label[found] or abs(largest[found] - 1.0) < OPEN):
        found += step
    return min(max(found, 0), count - 1)


def report(name: str) -> None:
    """Print the special orbits of a case, and what motions beside them do."""
    preset, parameters, fields = CASES[name]
    job = {"kind": "continuation", "scene": {"preset": preset, "parameters": parameters}} | fields
    begun = time.process_time()
    results = run(job, processes=1).study()
    seconds = time.process_time() - begun
    (branch,) = branches(results)
    print(f"{name}: {preset}, {parameters}", flush=True)
    if branch.failure:
        print(f"  {branch.failure.detail}")
        return
    study = admit(job)
    assert isinstance(study, ContinuationStudy)
    bare = section_map(study)
    value, unstable = branch.column("value"), branch.column("unstable")
    settled = Settled(np.zeros(0), np.full(bare.kernel.states, np.inf), np.inf, np.inf)
    map_ = scaled(bare, float(value[0]), settled).map
    assert isinstance(map_, SectionMap)
    count = len(value)
    ordinary = count - sum(one.label in ("LP", "PD", "NS", "BP", "GR") for one in branch.special)
    print(
        f"  {count} orbits, {seconds / ordinary:.2f} s each, {value.min():.9g} to {value.max():.9g}"
    )
    for one in branch.special:
        print(f"  {one.label} {one.value:.12g} +- {one.bound:.1g}  {one.note}", flush=True)
        if one.label not in ("LP", "PD", "NS", "GR"):
            continue
        for step, word in ((-1, "before"), (1, "behind")):
            row = beside(branch, one.row, step)
            does = shown(map_, branch, row, float(value[row]))
            print(
                f"    {word:6} {value[row]:.9g}, {unstable[row]:.0f} unstable: {does}", flush=True
            )
        if one.label == "LP":
            out = np.sign(one.value - value[one.row - 1]) * BEYOND * study.reach.high
            does = shown(map_, branch, one.row, one.value + float(out))
            print(f"    beyond {one.value + out:.9g}, no orbit: {does}", flush=True)


def main() -> None:
    """Print every case, or those that are named."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks branches", description=__doc__)
    parser.add_argument("--only", choices=CASES, nargs="+", default=list(CASES))
    for name in parser.parse_args().only:
        report(name)


if __name__ == "__main__":
    main()
