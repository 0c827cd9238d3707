"""In free flight nothing passes unseen between the ends of long steps."""

import math

import numpy as np
import pytest

from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.loop.runs import SECTIONS, SectionKind, Status
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import Event, LaneProblem
from tests.solver.completed_runs import run
from tests.solver.runs.free_flights import Flight, Pair, ring, rotor

ACCURACIES = (
    ("tsitouras", 1e-9),
    ("tsitouras", 1e-6),
    ("bogacki-shampine", 1e-4),
    ("dormand-prince-853", 1e-3),
)
LOOKS = 200_001


def first_onset(flight: Flight, method: str, tolerance: float) -> float:
    """Return when a contact first begins, s; infinite if none does before the end."""
    job = {"kind": "simulate", "scene": flight.scene, "duration": flight.duration}
    admission = admit({**job, "method": method, "tolerance": tolerance})
    assert isinstance(admission, Admission)
    kernel = ready_kernel(admission.scene, "reduced", method)
    event = Event(SectionKind.ONSET, 0)
    end = flight.duration
    problem = LaneProblem(admission.scene, end, tolerance, end, 0, 1, 0.0, event=event)
    bundle = Bundle(kernel, [problem], watch=False)
    bundle.advance(1_000_000)
    assert bundle.lane(0).status == Status.DONE
    rows = bundle.rows(SECTIONS, 0)
    return float(bundle.times(0, rows)[0]) if len(rows) else math.inf


def check(flight: Flight, found: float) -> None:
    """Check that a contact begins where the gap closes, and that it was open until then."""
    end = min(found, flight.duration)
    before = np.linspace(0.0, end, LOOKS)[:-1]
    # positions are right to the rounding of a path of some metres, 1e-15 m
    assert flight.gap(before).max() <= 1e-12 * flight.clearance + 1e-14
    if found < math.inf:
        assert abs(flight.gap(np.array([found]))[0]) <= 1e-7 * flight.clearance


def test_a_rotor_that_turns_fast_touches_when_it_does() -> None:
    # a journal that circles 15 rad a hundredth of the scene's own time, the step of free flight
    flight = rotor(5e-4, (2.8e-4, 0.0), 1000.0, (0.0134, 0.0609), (-2.4e-5, -1.8e-5), 9.81, 0.03)
    truth = flight.first_contact(LOOKS)
    assert 0.0015 < truth < 0.0025
    found = run(flight.scene, flight.duration)
    assert found.contacts("J")["onset"][0] == pytest.approx(truth, rel=1e-9)


def test_a_rotor_without_gravity_touches_when_it_does() -> None:
    flight = rotor(5e-4, (3e-4, 0.0), 2000.0, (0.02, 0.0), (0.0, 0.0), 0.0, 0.06)
    truth = flight.first_contact(LOOKS)
    assert 0.0009 < truth < 0.0012
    found = run(flight.scene, flight.duration)
    assert found.contacts("J")["onset"][0] == pytest.approx(truth, rel=1e-9)


@pytest.mark.parametrize("slow", [0.3, 3.0, 299.7, 300.0, 1.2345678])
def test_a_driver_that_touches_nothing_moves_no_impact(slow: float) -> None:
    flight = ring(0.005, 0.0046, 300.0, slow, 0.0, (0.05, 0.0), (0.0, 0.0046), 0.0, 0.1)
    truth = flight.first_contact(LOOKS)
    assert truth == pytest.approx(0.02183, abs=1e-4)
    found = run(flight.scene, flight.duration)
    assert found.contacts("E")["onset"][0] == pytest.approx(truth, rel=1e-9)


def random_flight(rng: np.random.Generator) -> Flight:
    """Return a rotor or a ring with numbers of many magnitudes."""

    def between(low: float, high: float) -> float:
        return float(10.0 ** rng.uniform(low, high))

    def directed(length: float) -> Pair:
        angle = rng.uniform(0.0, 2.0 * math.pi)
        return length * math.cos(angle), length * math.sin(angle)

    clearance = between(-5.0, -2.0)
    eccentricity = directed(clearance * math.sqrt(rng.uniform(0.0, 0.98)))
    gravity = between(-1.0, 2.0) if rng.random() < 0.6 else 0.0
    velocity = directed(between(-5.0, 0.0))
    radius = clearance * rng.uniform(0.1, 1.5) if rng.random() < 0.6 else between(-5.0, -1.0)
    spin = float(rng.choice([-1.0, 1.0])) * between(0.0, 4.5)
    fast = between(0.0, 3.5)
    slow = float(rng.choice([0.3, fast * rng.integers(1, 1000) / 1000.0, between(-3.0, 3.0)]))
    is_rotor = rng.random() < 0.5
    turning = abs(spin) if is_rotor else max(abs(spin), fast)
    # not longer than thirty turns or crossings of the clearance: else the looks would be too few
    rate = math.hypot(*velocity) + turning * radius
    duration = min(30.0 * 2.0 * math.pi / turning, 150.0 * clearance / rate)
    if is_rotor:
        point = directed(radius)
        return rotor(clearance, point, spin, velocity, eccentricity, gravity, duration)
    return ring(clearance, radius, fast, slow, spin, velocity, eccentricity, gravity, duration)


@pytest.mark.parametrize(
    ("seed", "count", "methods"),
    [(1, 8, 2), pytest.param(2, 3000, len(ACCURACIES), marks=pytest.mark.long)],
)
def test_a_first_contact_is_never_missed(seed: int, count: int, methods: int) -> None:
    rng = np.random.default_rng(seed)
    touched = 0
    for i in range(count):
        flight = random_flight(rng)
        found = first_onset(flight, *ACCURACIES[i % methods])
        check(flight, found)
        touched += found < math.inf
    assert touched > count / 2  # else there would be little to miss


@pytest.mark.long  # a million steps before the implicit method is tried
def test_drivers_whose_common_period_is_long_leave_a_run_its_pace() -> None:
    # the common period, 21 s, is a thousand of the fastest: measured by it, no run with friction
    # that chatters makes progress, before the implicit method can be tried
    parameters = {"speed": 300.0, "speed_crank4": 0.3, "friction": 10.0}
    found = run("seven-bar-press", 0.002, parameters=parameters)
    assert found.time[-1] == 0.002
    assert found.statistics["method"] == "rodas"
