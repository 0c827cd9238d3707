"""Multipliers of orbits of random mechanisms beside differences of simulations.

The product's multipliers come from central differences of runs beside one another in one bundle.
Here each run is a simulation of its own, by another method, a tenth of the tolerance, at other
distances from the orbit: its section after a period is read from the results. Multipliers agree if
they differ by less than both errors, that of these differences being twice how far those of other
distances are from the nearest, whose noise is largest.
Orbits in contact at the section are left out: the impact rate there is not read.
"""

import argparse
import json
from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.optimize import linear_sum_assignment

from benchmarks.basin_scenes import cubic_oscillator, shaking
from benchmarks.continuation import scene as impact_oscillator
from benchmarks.known_orbits import NATURAL, pendulum, with_dry_friction
from jointplay.client import Refused
from jointplay.local import run
from jointplay.records.arrays import Floats
from jointplay.records.branch import Branch, branches
from jointplay.solver.laws.dissipation import LAWS

Draw = Callable[[np.random.Generator], dict[str, Any]]
DISTANCES = 1e-3, 3e-4, 1e-4
"""Shares of the extent of each state."""
TOLERANCE, METHOD = 1e-12, "dormand-prince-853"
CHANNELS = {"theta": ("theta", "omega"), "s": ("x", "vx")}


def swinging(random: np.random.Generator) -> dict[str, Any]:
    """Return a driven pendulum, its drive and its damping."""
    found = pendulum()
    found["parameters"]["strength"]["default"] = random.uniform(0.1, 1.07)
    found["forces"]["damper"]["damping"] = NATURAL * random.uniform(0.2, 1.0)
    return {"scene": found, "parameter": "strength"}


def shaken(random: np.random.Generator) -> dict[str, Any]:
    """Return Duffing's oscillator at some frequency."""
    wave = shaking(random.uniform(0.05, 2.0), random.uniform(0.5, 1.6))
    found = cubic_oscillator(random.uniform(0.05, 0.4), random.uniform(0.0, 1.0), shaking=wave)
    return _with_strength(found, "shaking")


def rubbing(random: np.random.Generator) -> dict[str, Any]:
    """Return an oscillator with dry friction."""
    found = with_dry_friction(random.uniform(1.1, 2.0), 10.0 ** random.uniform(-3.0, -1.0))
    found["forces"]["rubbing"]["magnitude"] = random.uniform(0.02, 0.2)
    return {"scene": found, "parameter": "drive"}


def striking(random: np.random.Generator) -> dict[str, Any]:
    """Return an impact oscillator whose stop has a law of the roster."""
    stop = 10.0 ** random.uniform(5.0, 9.0)
    found = impact_oscillator(stop)
    sizes = {
        "restitution": random.uniform(0.3, 0.95),
        "damping": stop * random.uniform(0.01, 0.3),
        "effective_mass": 1.0,
        "loss": random.uniform(0.05, 0.5),
        "relaxation_time": 10.0 ** random.uniform(-5.0, -3.0),
    }
    name = str(random.choice([law for law in LAWS if law != "none"]))
    fields = {one: size for one, size in sizes.items() if one in LAWS[name].model_fields}
    contact = found["joints"]["stop"]["clearance"]["contact"]
    contact["dissipation"] = {"law": name} | fields
    for parameter, value in (("speed", random.uniform(16.0, 30.0)), ("amplitude", 0.005)):
        found["parameters"][parameter]["default"] = value
    return {"scene": found, "parameter": "amplitude"}


FAMILIES: dict[str, Draw] = {
    "pendulum": swinging,
    "Duffing": shaken,
    "dry friction": rubbing,
    "impact oscillator": striking,
}


def _with_strength(found: dict[str, Any], force: str) -> dict[str, Any]:
    strength = found["forces"][force]["magnitude"]
    declared = {"help": "Force.", "unit": "N", "default": strength}
    declared["targets"] = [{"path": f"/forces/{force}/magnitude"}]
    return {"scene": found | {"parameters": {"strength": declared}}, "parameter": "strength"}


def orbit_of(drawn: dict[str, Any]) -> Branch | None:
    """Return a short branch that begins at an orbit, if there is one."""
    at = drawn["scene"]["parameters"][drawn["parameter"]]["default"]
    values = {"from": at, "to": at * 1.0001, "count": 2}
    job = {"kind": "continuation", "settle": 300, "values": values} | drawn
    (branch,) = branches(run(job, processes=1).study())
    touches = any(
        values[0] > 0.0
        for one, values in branch.columns.items()
        if one.name.startswith("impact_rate.") and len(values)
    )
    return None if branch.failure or touches else branch


def multipliers(columns: dict[str, Floats]) -> Floats:
    """Return the product's multipliers of the first orbit, complex."""
    count = sum(name.endswith(".real") for name in columns)
    return np.array(
        [
            columns[f"multiplier_{k}.real"][0] + 1j * columns[f"multiplier_{k}.imaginary"][0]
            for k in range(1, count + 1)
        ]
    )


def by_simulations(drawn: dict[str, Any], columns: dict[str, Floats], share: float) -> Floats:
    """Return the section map's derivative by simulations that start this far from the orbit."""
    scene = json.loads(json.dumps(drawn["scene"]))
    names = [name for name in columns if name.startswith(("state.", "rate."))]
    rates = [name for name in columns if name.startswith("impact_rate.")]
    duration = float(columns["duration"][0])
    section = np.array([columns[name][0] for name in (*names, *rates)])
    read = [_channel(name) for name in names]
    sizes = np.abs(section[: len(names)])
    extents = np.maximum(sizes, 0.3 * sizes.max())

    def after(state: Floats) -> Floats:
        job = {"kind": "simulate", "scene": scene, "duration": duration, "state": state.tolist()}
        job |= {"tolerance": TOLERANCE, "method": METHOD, "certificate": False, "channels": read}
        history = run(job).history
        return np.array([float(history[name].values[-1]) for name in read])

    found = np.empty((len(names), len(names)))
    for k, extent in enumerate(extents):
        step = np.zeros(len(section))
        step[k] = share * extent
        found[:, k] = (after(section + step) - after(section - step)) / (2.0 * share * extent)
    return found


def _channel(name: str) -> str:
    """Return the channel of a column: `rate.mass.s` is mass.vx."""
    kind, body, coordinate = name.split(".")
    return f"{body}.{CHANNELS[coordinate][kind == 'rate']}"


def compared(drawn: dict[str, Any], branch: Branch) -> tuple[float, float]:
    """Return how far multipliers are apart, and what both errors allow."""
    columns = {one.name: values for one, values in branch.columns.items()}
    own = multipliers(columns)
    *coarse, fine = (
        np.linalg.eigvals(by_simulations(drawn, columns, share)) for share in DISTANCES
    )
    part = max(_apart(one, fine) for one in coarse)
    return _apart(own, fine), 2.0 * part + float(columns["multiplier_error"][0])


def _matched(places: Floats, like: Floats) -> Floats:
    """Return places in the order of those that they are next to."""
    _, order = linear_sum_assignment(np.abs(like[:, None] - places))
    return np.asarray(places[order])


def _apart(places: Floats, others: Floats) -> float:
    return float(np.abs(_matched(places, others) - others).max())


def main() -> None:
    """Print a line each orbit that is outside, and the counts."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--orbits", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    random, names = np.random.default_rng(given.seed), list(FAMILIES)
    counts = {name: [0, 0, 0] for name in names}
    ratios = []
    while len(ratios) < given.orbits:
        name = names[len(ratios) % len(names)]
        drawn = FAMILIES[name](random)
        try:
            branch = orbit_of(drawn)
        except Refused as error:
            raise SystemExit(f"{name}: {error}") from None
        if branch is None:
            counts[name][2] += 1
            continue
        apart, allowed = compared(drawn, branch)
        ratios.append(apart / allowed)
        inside = apart <= allowed
        counts[name][0 if inside else 1] += 1
        if not inside:
            print(f"{name}: {apart:.1e} apart, {allowed:.1e} allowed; {json.dumps(drawn)}")
    for name, (inside, outside, without) in counts.items():
        print(f"{name:20}{inside:5} within, {outside} outside, {without} drawn without one")
    print(f"distances by what is allowed: median {np.median(ratios):.2g}, worst {max(ratios):.2g}")


if __name__ == "__main__":
    main()
