"""Newton's and Euler's laws, momentum and energy, from what a finished job shows and nothing else.

The mechanism has a joint of every type, play, a motor, a spring and gravity. What acts on whom is
read off the document: a joint's channels are the force on its second body, at that body's point,
and, where an angle is held, the moment on it.
"""

import math
from functools import cache
from typing import Any, NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

import jointplay
from jointplay.client.job import Job

Floats = NDArray[np.float64]

END, STEP = 0.06, 1e-6
RADIUS, CLEARANCE = 0.012, 5e-4
SECOND = {"revolute": "journal", "prismatic": "slider", "fixed": "part"}
FIRST = {"revolute": "bearing", "prismatic": "guide", "fixed": "base"}
GRAVITY = (1.0, -9.81)
SPRING = {"stiffness": 2000.0, "damping": 3.0, "free_length": 0.2}


def machine(turned: bool) -> dict[str, Any]:
    """Return a slider-crank with play whose slider carries a tool; `turned` swaps joints' ends."""
    guide = {"guide": "ground.rail", "slider": "slider.shoe", "axis": [1.0, 0.2]}
    weld = {"base": "slider.top", "part": "tool.foot", "angle": 0.3}
    if turned:  # the axis belongs to the slider then, which slides along itself
        guide = {"guide": "slider.shoe", "slider": "ground.rail", "axis": [1.0, 0.2]}
        weld = {"base": "tool.foot", "part": "slider.top", "angle": -0.3}
    return {
        "name": "machine",
        "gravity": list(GRAVITY),
        "ground": {"points": {"O": [0.0, 0.0], "rail": [0.05, 0.01], "wall": [0.6, 0.2]}},
        "bodies": {
            "crank": {
                "mass": 0.7,
                "inertia": 8e-4,
                "points": {"O": [-0.02, 0.004], "pin": [0.03, 0.0]},
            },
            "rod": {
                "mass": 0.9,
                "inertia": 4e-3,
                "points": {"big": [-0.08, 0.003], "small": [0.1, 0.0]},
            },
            "slider": {
                "mass": 1.3,
                "inertia": 2e-3,
                "points": {"pin": [0.01, 0.0], "shoe": [0.0, -0.02], "top": [0.03, 0.04]},
            },
            "tool": {
                "mass": 0.4,
                "inertia": 5e-4,
                "points": {"foot": [0.0, -0.05], "hook": [0.02, 0.05]},
            },
        },
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "crank.O"},
            "P": {
                "type": "revolute",
                "bearing": "crank.pin",
                "journal": "rod.big",
                "clearance": {
                    "radial_clearance": CLEARANCE,
                    "bearing_radius": RADIUS,
                    "contact": {"stiffness": 1e9, "restitution": 0.6},
                    "friction": {
                        "coefficient": 0.2,
                        "static_velocity": 0.01,
                        "dynamic_velocity": 0.1,
                    },
                },
            },
            "Q": {"type": "revolute", "bearing": "rod.small", "journal": "slider.pin"},
            "rail": {"type": "prismatic", **guide},
            "weld": {"type": "fixed", **weld},
        },
        "drivers": {"motor": {"joint": "O", "position": 0.4, "speed": 90.0}},
        "forces": {
            "spring": {
                "type": "spring-damper",
                "first": "ground.wall",
                "second": "tool.hook",
                **SPRING,
            }
        },
    }


class Seen(NamedTuple):
    """A finished job, its document and its channels over time."""

    scene: dict[str, Any]
    job: Job
    time: Floats
    channels: dict[str, Floats]

    def __getitem__(self, name: str) -> Floats:
        return self.channels[name]

    def arm(self, reference: str) -> tuple[Floats, Floats]:
        """Return the vector from a body's centre to one of its points; of the ground's from 0."""
        body, point = reference.split(".")
        if body == "ground":
            x, y = self.scene["ground"]["points"][point]
            return np.full_like(self.time, x), np.full_like(self.time, y)
        x, y = self.scene["bodies"][body]["points"][point]
        angle = self[f"{body}.theta"]
        return x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle)

    def position(self, reference: str) -> tuple[Floats, Floats]:
        """Return where a point is."""
        body = reference.split(".")[0]
        ax, ay = self.arm(reference)
        if body == "ground":
            return ax, ay
        return self[f"{body}.x"] + ax, self[f"{body}.y"] + ay


@cache
def seen(formulation: str, turned: bool) -> Seen:
    scene = machine(turned)
    job = jointplay.run(
        scene, duration=END, output_step=STEP, formulation=formulation, certificate=False
    )
    window = job.window()
    return Seen(scene, job, window.time, {name: window[name] for name in window.channels})


@pytest.fixture(
    params=[
        pytest.param(("reduced", False), marks=pytest.mark.long),
        ("reduced", True),
        ("lagrange", False),
        pytest.param(("lagrange", True), marks=pytest.mark.long),
    ],
    ids=["reduced", "reduced, turned", "lagrange", "lagrange, turned"],
)
def run(request: pytest.FixtureRequest) -> Seen:
    return seen(*request.param)


class Load:
    """Force and moment about the centre of mass of a body, (samples,) each."""

    def __init__(self, run: Seen, mass: float) -> None:
        nothing = np.zeros_like(run.time)
        self.x, self.y, self.moment = (
            nothing + mass * GRAVITY[0],
            nothing + mass * GRAVITY[1],
            nothing,
        )

    def add(self, at: tuple[Floats, Floats], force: tuple[Floats, Floats], sign: float) -> None:
        """Add a force at a point, given from the centre of mass."""
        self.x = self.x + sign * force[0]
        self.y = self.y + sign * force[1]
        self.moment = self.moment + sign * (at[0] * force[1] - at[1] * force[0])


def loads(run: Seen) -> dict[str, Load]:
    """Return everything that acts on each body."""
    found = {name: Load(run, body["mass"]) for name, body in run.scene["bodies"].items()}
    for name, joint in run.scene["joints"].items():
        first, second = joint[FIRST[joint["type"]]], joint[SECOND[joint["type"]]]
        force = run[f"{name}.force_x"], run[f"{name}.force_y"]
        held = run.channels.get(f"{name}.moment", np.zeros_like(run.time))
        loose = "clearance" in joint
        rubbing = run[f"{name}.friction_force"] if loose else np.zeros_like(run.time)
        there = run.position(second)
        for reference, sign, lever in ((second, 1.0, RADIUS - CLEARANCE), (first, -1.0, RADIUS)):
            body = reference.split(".")[0]
            if body == "ground":
                continue
            # bodies of an ideal joint meet at the second's point; play has a point for each
            x, y = run.position(reference) if loose else there
            at = x - run[f"{body}.x"], y - run[f"{body}.y"]
            found[body].add(at, force, sign)
            found[body].moment = found[body].moment + sign * (held + lever * rubbing)
    found["crank"].moment = found["crank"].moment + run["motor.torque"]
    (px, py), (qx, qy) = run.position("ground.wall"), run.position("tool.hook")
    length = np.hypot(qx - px, qy - py)
    pull = run["spring.force"] * (px - qx) / length, run["spring.force"] * (py - qy) / length
    found["tool"].add(run.arm("tool.hook"), pull, 1.0)
    return found


def test_mass_times_acceleration_is_the_force_on_every_body(run: Seen) -> None:
    largest = max(float(np.abs(run[f"{joint}.force_x"]).max()) for joint in run.scene["joints"])
    for name, load in loads(run).items():
        mass, inertia = (run.scene["bodies"][name][field] for field in ("mass", "inertia"))
        # sums of forces in double precision; multipliers keep points together to some 1e-11 m only,
        # and that far from each other's point forces have a moment
        np.testing.assert_allclose(mass * run[f"{name}.ax"], load.x, rtol=0, atol=1e-10 * largest)
        np.testing.assert_allclose(mass * run[f"{name}.ay"], load.y, rtol=0, atol=1e-10 * largest)
        np.testing.assert_allclose(
            inertia * run[f"{name}.alpha"], load.moment, rtol=0, atol=1e-10 * largest
        )


def test_momentum_changes_by_the_impulses_of_the_forces(run: Seen) -> None:
    for name, load in loads(run).items():
        mass, inertia = (run.scene["bodies"][name][field] for field in ("mass", "inertia"))
        for factor, rate, force in (
            (mass, "vx", load.x),
            (mass, "vy", load.y),
            (inertia, "omega", load.moment),
        ):
            gained = factor * (run[f"{name}.{rate}"] - run[f"{name}.{rate}"][0])
            whole = float(np.trapezoid(np.abs(force), run.time))
            # impacts of 0.2 ms in samples of 1 us; steps are good to 1e-6
            np.testing.assert_allclose(
                gained, _integral(run.time, force), rtol=0, atol=1e-4 * whole + 1e-12
            )


def test_an_impact_has_the_impulse_of_its_normal_force(run: Seen) -> None:
    impacts = run.job.results.impacts()
    assert len(impacts.onset) >= 5
    total = _integral(run.time, run["P.normal_force"])
    for onset, release, impulse in zip(
        impacts.onset, impacts.release, impacts.impulse, strict=True
    ):
        end = release if math.isfinite(release) else END
        found = np.interp(end, run.time, total) - np.interp(onset, run.time, total)
        assert found == pytest.approx(impulse, rel=1e-3, abs=1e-3 * STEP * 1e4)


def test_the_energy_ledger_is_that_of_the_channels(run: Seen) -> None:
    rate = run["P.eccentricity_rate_x"] * run["P.eccentricity_x"]
    rate = rate + run["P.eccentricity_rate_y"] * run["P.eccentricity_y"]
    apart = np.hypot(run["P.eccentricity_x"], run["P.eccentricity_y"])
    rate = rate / np.where(apart > 0.0, apart, 1.0)  # it starts concentric
    works = {
        "driver": _integral(run.time, run["motor.power"])[-1],
        "contact": _integral(run.time, run["P.normal_force"] * rate)[-1],
        "friction": _integral(run.time, -run["P.friction_force"] * run["P.slip_velocity"])[-1],
        "damper": SPRING["damping"] * _integral(run.time, run["spring.rate"] ** 2)[-1],
    }
    stored = 0.5 * SPRING["stiffness"] * (run["spring.length"] - SPRING["free_length"]) ** 2
    energy = run["energy.kinetic"] + run["energy.potential"] + stored
    kinetic = sum(
        0.5 * body["mass"] * (run[f"{name}.vx"] ** 2 + run[f"{name}.vy"] ** 2)
        + 0.5 * body["inertia"] * run[f"{name}.omega"] ** 2
        for name, body in run.scene["bodies"].items()
    )
    np.testing.assert_allclose(run["energy.kinetic"], kinetic, rtol=1e-12)
    gained = float(energy[-1] - energy[0])
    ledger = run.job.statistics["energy"]
    gross = ledger["gross_work"]
    put_in = works["driver"] - works["contact"] - works["friction"] - works["damper"]
    # quadrature of impacts in samples of 1 us
    assert gained == pytest.approx(put_in, abs=1e-4 * gross)
    assert ledger["driver_work"] == pytest.approx(works["driver"], abs=1e-4 * gross)
    assert ledger["friction_loss"] == pytest.approx(works["friction"], abs=1e-4 * gross)
    assert abs(ledger["residual"]) < 1e-5 * gross


def _integral(time: Floats, values: Floats) -> Floats:
    """Return the integral up to each sample, by trapezia."""
    pieces = 0.5 * (values[1:] + values[:-1]) * np.diff(time)
    return np.concatenate([[0.0], np.cumsum(pieces)])
