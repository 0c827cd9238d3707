"""Jobs that are admitted: every default filled in, and one digest for one computation."""

from typing import Any

import pytest

from jointplay.scene_choice import with_parameters
from jointplay.solver.kinds import admit, documents, parse
from jointplay.solver.scene import presets
from tests.presets_given import given

JOB: dict[str, Any] = {
    "kind": "simulate",
    "scene": {"preset": "seven-bar-press", "parameters": {}},
    "duration": 2.0,
}


@pytest.mark.parametrize("name", presets.names())
def test_admission_fills_in_everything_and_is_idempotent(name: str) -> None:
    first = admit({"kind": "simulate", "scene": given(name), "duration": 1.0})
    again = admit(first.job)
    assert again == first
    declared = presets.document(name)["parameters"]
    assert first.job["scene"]["parameters"].keys() == declared.keys()
    assert first.job["tolerance"] == 1e-6
    assert first.job["output_step"] == 1.0 / 2000
    assert first.job["formulation"] == "reduced"
    assert len(first.job["channels"]) == len(first.channels)


def test_the_digest_ignores_the_label_and_spelled_out_defaults_but_nothing_else() -> None:
    first = admit(JOB)
    assert admit({**JOB, "label": "a name"}).digest == first.digest
    assert admit({**JOB, "accuracy": "standard"}).digest == first.digest
    assert admit({**JOB, "duration": 2}).digest == first.digest
    assert admit({**JOB, "tolerance": 1e-7}).digest != first.digest
    changed = {**JOB, "scene": {"preset": "seven-bar-press", "parameters": {"friction": 0.02}}}
    assert admit(changed).digest != first.digest


@pytest.mark.parametrize(
    "chosen", [{"tolerance": 1e-9}, {"accuracy": "draft"}, {"method": "rk4", "step": 1e-4}]
)
def test_how_steps_are_taken_is_said_to_have_no_effect_where_there_are_none(chosen) -> None:
    scene = {"preset": "slider-crank", "parameters": {"clearance": 0.0}}
    job = {"kind": "simulate", "scene": scene, "duration": 0.1}
    assert admit(job).notes == ()
    found = admit(job | chosen)
    (note,) = found.notes
    assert "tolerance and step have no effect" in note
    assert parse(found.job).notes == (note,)
    scene["parameters"]["clearance"] = 1e-4
    assert admit(job | chosen).notes == ()


def test_a_field_that_is_newer_than_jobs_changes_no_digest_where_it_is_not_given() -> None:
    job = {"kind": "simulate", "scene": {"preset": "impact-oscillator"}, "duration": 0.1}
    found = admit(job)
    later = ("settle", "state")
    assert found.digest == documents.digest(
        {name: value for name, value in found.job.items() if name not in later}
    )
    assert admit(job | {"state": [0.0, 0.1]}).digest != found.digest


def test_a_parameter_overrides_and_follows_as_declared() -> None:
    def joints(**parameters: float) -> list[float]:
        scene = {"preset": "seven-bar-press", "parameters": parameters}
        found = admit({**JOB, "scene": scene}).scene_document()
        return [found["joints"][j]["clearance"]["radial_clearance"] for j in "AB"] + [
            found["drivers"][d]["speed"] for d in ("drive1", "drive4")
        ]

    assert joints(clearance=1e-4, speed=2.0) == [1e-4, 1e-4, 2.0, -2.0]
    assert joints(clearance=1e-4, clearance_B=2e-4, speed=2.0, speed_crank4=3.0) == [
        1e-4,
        2e-4,
        2.0,
        3.0,
    ]


def test_values_put_into_a_whole_scene_override_as_those_of_its_preset() -> None:
    values = {"clearance": 1e-4, "clearance_A": 2e-4, "clearance_B": 3e-4, "speed_crank4": 3.0}
    preset, whole = (
        admit({**JOB, "scene": with_parameters(scene, values)}).scene
        for scene in ({"preset": "seven-bar-press"}, presets.document("seven-bar-press"))
    )
    assert (whole.joints, whole.drivers) == (preset.joints, preset.drivers)
