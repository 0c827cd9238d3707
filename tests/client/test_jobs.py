"""Job documents by name, against the schemas of the solver."""

import inspect
import json

import numpy as np
import pytest

from jointplay import job_fields, jobs
from jointplay.client import Client
from jointplay.scene_choice import NotAScene
from jointplay.solver.kinds import KINDS, admit
from jointplay.solver.kinds.description import description
from jointplay.solver.scene import presets

MADE = {
    "simulate": jobs.simulate("slider-crank", duration=1, clearance=1e-4, label="one"),
    "bifurcation": jobs.bifurcation(
        "slider-crank", "clearance", np.linspace(1e-4, 5e-4, 3), settle="auto", indicators="all"
    ),
    "sweep": jobs.sweep(
        "slider-crank",
        {"clearance": {"from": 1e-4, "to": 5e-4, "count": 3}, "friction": (0, np.float64(0.1))},
        periods=2,
        channels="P.*",
    ),
    "poincare": jobs.poincare("slider-crank", record=7, section={"onset": "P"}),
    "accuracy-study": jobs.accuracy_study(
        "slider-crank", duration=0.1, methods="rodas", tolerances=(1e-4, np.float64(1e-6))
    ),
    "calibration": jobs.calibration(
        "slider-crank",
        {"stiffness": {"minimum": 1e8, "maximum": 1e9, "spacing": "log"}},
        [{"targets": [{"channel": "P.normal_force", "to": 0.1, "value": np.float64(100.0)}]}],
        tolerance=1e-5,
    ),
    "chart": jobs.chart(
        "slider-crank",
        {"parameter": "clearance", "values": np.array([1e-4, 2e-4])},
        {"parameter": "friction", "values": (0.0, 0.1)},
        record=20,
    ),
    "basins": jobs.basins(
        "slider-crank",
        {"start": "/drivers/motor/position", "values": (0.0, 1.0)},
        {"parameter": "friction", "values": (0.0, 0.1)},
        indicators="recurrence",
    ),
    "basin-stability": jobs.basin_stability(
        "slider-crank",
        {"/drivers/motor/position": {"distribution": "uniform", "low": 0.0, "high": np.float64(6)}},
        samples=np.int64(8),
        along={"parameter": "friction", "values": np.array([0.0, 0.1])},
        indicators="recurrence",
    ),
    "sensitivity": jobs.sensitivity(
        "slider-crank",
        {"clearance": {"distribution": "uniform", "low": np.float64(1e-4), "high": 5e-4}},
        design="morris",
        samples=8,
        periods=2,
    ),
    "continuation": jobs.continuation(
        "impact-oscillator",
        "speed",
        {"from": 20.0, "to": 30.0, "count": np.int64(9)},
        at=np.float64(25.0),
        doublings=2,
    ),
    "ensemble": jobs.ensemble("slider-crank", 4, seed=3, observables=["P.eccentricity_x"]),
}


def named(owner, kind):
    return getattr(owner, kind.replace("-", "_"))


@pytest.mark.parametrize("kind", KINDS)
def test_every_field_of_every_kind_can_be_given_and_is_no_parameter(kind):
    given = set(inspect.signature(named(jobs, kind)).parameters) - {"scene", "given"}
    fields = set(KINDS[kind].document.model_fields) - {"kind", "scene"}
    assert given == fields | {"cache", "expires"}
    for name in presets.names():
        assert not given & set(presets.document(name).get("parameters", {}))


def test_the_fields_are_those_that_the_solver_describes():
    """Else run `python -m jointplay.solver.kinds.description > src/jointplay/job_fields.json`."""
    assert description() == job_fields.KINDS


@pytest.mark.parametrize("kind", KINDS)
def test_help_names_every_field_with_a_sentence(kind):
    documentation = named(jobs, kind).__doc__
    for field in job_fields.KINDS[kind]["fields"]:
        _, _, text = documentation.partition(f"\n{field}\n    ")
        assert len(text.split("\n")[0]) > 10


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_made_is_admitted(kind):
    document = MADE[kind]
    assert document["kind"] == kind
    admitted = admit(json.loads(json.dumps(document))).job
    for name, value in document.items():
        if name not in ("scene", "values", "grid", "channels", "indicators", "cases"):
            assert admitted[name] == value


def test_a_scene_may_be_a_name_a_document_or_a_file(tmp_path):
    scene = presets.document("pendulum")
    (tmp_path / "mine.json").write_text(json.dumps(scene))
    assert jobs.simulate("pendulum", duration=1)["scene"] == {"preset": "pendulum"}
    whole = jobs.simulate(scene, duration=1, mass=2.5)["scene"]
    assert jobs.simulate(tmp_path / "mine.json", duration=1, mass=2.5)["scene"] == whole
    assert whole["parameters"]["mass"]["default"] == 2.5
    assert scene["parameters"]["mass"]["default"] != 2.5
    with pytest.raises(NotAScene, match="weight: the scene declares no such parameter"):
        jobs.simulate(scene, duration=1, weight=2.5)
    with pytest.raises(NotAScene, match=r"such parameter; did you mean 'tolerance'\?"):
        jobs.simulate(scene, duration=1, tolerence=1e-6)
    with pytest.raises(NotAScene, match=r"nowhere\.json: No such file"):
        jobs.simulate("nowhere.json", duration=1)


@pytest.mark.parametrize("kind", KINDS)
def test_a_client_has_a_method_of_each_kind_with_the_same_signature(kind):
    described, method = named(jobs, kind), named(Client, kind)
    assert method.__doc__ == described.__doc__
    own, *shared = inspect.signature(method).parameters.values()
    assert own.name == "self"
    assert shared == list(inspect.signature(described).parameters.values())
