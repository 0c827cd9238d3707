"""A friction law with a state of its own, from outside: Dahl's bristle."""

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Annotated, Any, Literal

import numpy as np
import pytest
from hypothesis import strategies as st
from pydantic import Field

from jointplay.client import Refused
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.laws.friction import LAWS
from jointplay.solver.laws.friction.law import FrictionLaw, InnerState
from jointplay.solver.quantities.scalars import Scalar, absolute
from jointplay.solver.runs.simulate import Simulation
from tests.seams.conftest import Platform
from tests.solver.completed_runs import Run, collect
from tests.solver.laws.specification.friction import FrictionSpecification


class Bristle(FrictionLaw):
    """F_t = -σ z F_n with z' = v - σ |v| z / μ: bristles bend with the slip until they slide.

    Assumes bristles that bend with the slip while apart, too. Fails to tell sticking friction from
    sliding: there is no Stribeck effect.

    Source: Dahl 1968, The Aerospace Corporation TOR-0158(3107-18), scaled with the normal force as
    by Canudas de Wit and Tsiotras 1999, eqs 7-8.
    """

    law: Literal["bristle"] = "bristle"
    coefficient: Annotated[float, Field(gt=0.0, le=10.0, json_schema_extra={"unit": "1"})]
    bristle_stiffness: Annotated[float, Field(gt=0.0, le=1e9, json_schema_extra={"unit": "1/m"})]

    @property
    def inner_states(self) -> tuple[InnerState, ...]:
        scale = self.coefficient / self.bristle_stiffness
        return (InnerState("bristle", "m", "deflection of the bristles", scale),)

    def friction_force(self, normal_force: Scalar, slip: Scalar, inner: Sequence[Scalar]) -> Scalar:
        return -(self.bristle_stiffness * inner[0] * normal_force)

    def inner_rates(
        self, normal_force: Scalar, slip: Scalar, inner: Sequence[Scalar]
    ) -> Sequence[Scalar]:
        bent = self.bristle_stiffness * inner[0] / self.coefficient
        return (slip - absolute(slip) * bent,)


class TestBristle(FrictionSpecification):
    model = Bristle
    laws = st.builds(
        Bristle, coefficient=st.floats(0.01, 1.0), bristle_stiffness=st.floats(1.0, 1e4)
    )


COEFFICIENT, BRISTLE = 0.2, 20.0
SPEED, SPIN = 0.2, 200.0
RADIUS, CLEARANCE = 0.01, 1e-3
SLIP = (RADIUS - CLEARANCE) * SPIN
PERIOD = 2e-3
FLIGHT = CLEARANCE / SPEED
"""The journal crosses its clearance in 5 ms; until then it slips by its spin alone."""


def thrown(**friction: Any) -> dict[str, Any]:
    """Return a scene: a weightless, spinning journal is thrown at its bearing; a clock goes on."""
    given = {"law": "bristle", "coefficient": COEFFICIENT, "bristle_stiffness": BRISTLE}
    return {
        "name": "thrown-journal",
        "ground": {"points": {"O": [0.0, 0.0], "wall": [1.0, 0.0]}},
        "bodies": {
            "journal": {"mass": 1.0, "inertia": 5e-5, "points": {"O": [0.0, 0.0]}},
            "clock": {"mass": 1.0, "inertia": 1.0, "points": {"O": [0.0, 0.0]}},
        },
        "joints": {
            "bearing": {
                "type": "revolute",
                "bearing": "ground.O",
                "journal": "journal.O",
                "clearance": {
                    "radial_clearance": CLEARANCE,
                    "bearing_radius": RADIUS,
                    "contact": {"stiffness": 1e8, "restitution": 0.9},
                    "friction": given | friction,
                },
            },
            "axle": {"type": "revolute", "bearing": "ground.wall", "journal": "clock.O"},
        },
        "drivers": {"motor": {"joint": "axle", "speed": 2.0 * np.pi / PERIOD}},
        "start": {
            "velocities": {"journal": [SPEED, 0.0]},
            "angular_velocities": {"journal": SPIN},
        },
        "parameters": {
            "mu": {
                "help": "Coefficient of friction.",
                "targets": [{"path": "/joints/bearing/clearance/friction/coefficient"}],
            }
        },
    }


def bristle(time: Any, coefficient: float = COEFFICIENT, begun: float = 0.0) -> Any:
    """Return the deflection at a constant slip, m; `begun` is that at time 0."""
    full = coefficient / BRISTLE
    return full + (begun - full) * np.exp(-SLIP / full * time)


SIMULATE = {"kind": "simulate", "duration": 0.05, "output_step": 1e-5, "tolerance": 1e-8}


@pytest.fixture
def bristles() -> Iterator[None]:
    LAWS["bristle"] = Bristle
    yield
    del LAWS["bristle"]


def test_a_law_that_is_in_no_registry_is_refused_at_its_tag(platform: Platform) -> None:
    with pytest.raises(Refused) as refused:
        platform.client.submit(SIMULATE | {"scene": thrown()})
    (field,) = refused.value.fields
    assert field.pointer == "/scene/joints/bearing/clearance/friction/law"
    assert "'modified-coulomb'" in field.detail


@pytest.mark.usefixtures("bristles")
@pytest.mark.parametrize(
    ("method", "formulation"),
    [
        ("tsitouras", "lagrange"),
        ("rodas", "reduced"),
        pytest.param("tsitouras", "reduced", marks=pytest.mark.long),
        pytest.param("rodas", "lagrange", marks=pytest.mark.long),
    ],
)
def test_bristles_bend_until_they_slide(platform: Platform, formulation: str, method: str) -> None:
    document = SIMULATE | {"scene": thrown(), "formulation": formulation, "method": method}
    job = platform.computed(document)
    assert job.state == "succeeded"
    found = job.window("bearing.*")
    assert found.channels["bearing.bristle"].unit == "m"
    deflection, slip = found["bearing.bristle"], found["bearing.slip_velocity"]
    flying = found.time < FLIGHT
    # tolerance 1e-8 a step, relative to the law's own scale of 1 cm, over some thousand steps
    np.testing.assert_allclose(deflection[flying], bristle(found.time[flying]), atol=1e-7)
    # each impact turns the slip's sign or stops it; what bristles do is what their slip asks
    assert len(job.impacts) > 3
    integrated = [0.0]
    for before, after in pairwise(slip):
        z, step, v = integrated[-1], 1e-5, 0.5 * (before + after)
        full = COEFFICIENT / BRISTLE * np.sign(v)
        integrated.append(full + (z - full) * np.exp(-BRISTLE * abs(v) * step / COEFFICIENT))
    # slip is not linear within 10 us of an impact: a share of 1e-3 of the bristles' scale
    np.testing.assert_allclose(deflection, integrated, atol=1e-3 * COEFFICIENT / BRISTLE)
    force = -BRISTLE * deflection * found["bearing.normal_force"]
    np.testing.assert_allclose(found["bearing.friction_force"], force, rtol=1e-9, atol=1e-9)
    energy = job.statistics["energy"]
    assert energy["friction_loss"] > 0.01
    assert abs(energy["residual"]) < 1e-5 * energy["gross_work"]
    assert job.certificate["exponent"] is not None
    assert np.isfinite(job.certificate["exponent"]["value"])


def run_to_end(simulation: Simulation) -> Run:
    return collect(simulation.admission, list(simulation.slices()), simulation)


@pytest.mark.usefixtures("bristles")
@pytest.mark.parametrize("formulation", ["reduced", "lagrange"])
def test_a_run_that_is_taken_up_again_has_the_same_bits(formulation: str) -> None:
    document = {"scene": thrown(), "formulation": formulation, "duration": 2.0, "output_step": 1e-3}
    admission = admit(SIMULATE | document)
    assert isinstance(admission, Admission)
    whole = run_to_end(Simulation(admission))
    begun = Simulation(admission)
    first = [next(begun.slices())]
    assert first[0].fraction < 1.0
    resumed = Simulation(admission, begun.checkpoint())
    rest = collect(admission, [*first, *resumed.slices()], resumed)
    for name, values in whole.samples.items():
        np.testing.assert_array_equal(rest.samples[name], values)
    assert rest.peaks == whole.peaks


@pytest.mark.usefixtures("bristles")
def test_a_continuation_hands_bristles_on_to_the_next_value(platform: Platform) -> None:
    job = platform.computed(
        {
            "kind": "bifurcation",
            "scene": thrown(),
            "parameter": "mu",
            "values": [0.1, 0.3],
            "continuation": "forward",
            "chains": 1,
            "settle": 0,
            "record": 1,
            "observables": ["bearing.bristle"],
            "tolerance": 1e-8,
        }
    )
    assert job.state == "succeeded"
    # a section is taken at the end of a period; both are over before the journal touches
    first = bristle(PERIOD, 0.1)
    study = job.study()
    found = study.sections("bearing.bristle")[:, 0]
    np.testing.assert_allclose(found, [first, bristle(PERIOD, 0.3, first)], rtol=1e-6)


@pytest.mark.usefixtures("bristles")
def test_members_of_an_ensemble_start_with_bristles_of_their_own(platform: Platform) -> None:
    job = platform.computed(
        {
            "kind": "ensemble",
            "scene": thrown(),
            "members": 3,
            "spread": 0.1,
            "settle": 0,
            "record": 2,
            "observables": ["bearing.bristle"],
            "indicators": ["lyapunov"],
        }
    )
    assert job.state == "succeeded"
    assert (job.points["status"] == "done").all()
