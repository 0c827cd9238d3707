"""Contacts that steps make, not the motion: the certificate says so."""

import pytest

from benchmarks.lies.run import Finished, finish
from jointplay.solver.kinds import admit
from jointplay.solver.runs.simulate import Simulation
from tests.solver.held_part import held_part
from tests.solver.laws.thrown import pair, thrown


@pytest.mark.parametrize(("tolerance", "chatters"), [(1e-5, True), (1e-7, False)])
def test_a_press_so_hard_that_a_loose_tolerance_chatters(tolerance: float, chatters: bool) -> None:
    scene = {"preset": "seven-bar-press", "parameters": {"stiffness": 1e13}}
    run = finish({"kind": "simulate", "scene": scene, "duration": 0.5, "tolerance": tolerance})
    assert isinstance(run, Finished)
    assert run.certificate is not None
    facts = run.certificate.facts
    own, tighter = (lane["onsets"] for lane in facts["lanes"][:2])
    assert (own > 2 * tighter) == chatters
    assert (f"{own} contacts, and {tighter} at a quarter" in facts["note"]) == chatters
    assert ("ask for a smaller tolerance" in facts["note"]) == chatters
    assert facts["impacts"]["count"] == own
    assert facts["impacts"]["until"] <= facts["horizon"]
    # so hard that some impacts are slower than the floor of 1 mm/s that the preset gives
    assert facts["slow_impacts"] > 0
    assert f"{facts['slow_impacts']} impacts were slower than the impact" in facts["note"]


def test_contacts_from_the_start_on_count_in_a_run_that_is_broken_off() -> None:
    job = {"kind": "simulate", "scene": held_part(), "duration": 2.0, "method": "tsitouras"}
    simulation = Simulation(admit(job))
    assert next(simulation.slices()).samples.any()
    certificate = simulation.certificate()
    assert certificate is not None
    assert certificate.facts["impacts"]["count"] == 2  # both corners that it is pressed on


@pytest.mark.parametrize("name", ["penetration", "eccentricity_x", "x"])
def test_an_output_may_have_the_name_of_a_quantity_of_joints_or_bodies(name: str) -> None:
    scene = thrown(pair({"law": "power", "stiffness": 1e9}, {"law": "exact", "restitution": 0.2}))
    scene["outputs"] = [{"name": name, "channel": "bearing0.penetration", "factor": 1e3}]
    run = finish({"kind": "simulate", "scene": scene, "duration": 1e-3, "tolerance": 1e-6})
    assert isinstance(run, Finished)
    assert run.certificate is not None
    assert len(run.certificate.until) == len(run.certificate.facts["kinds"])


@pytest.mark.parametrize(("gravity", "lasts"), [(2000.0, True), (0.0, False)])
def test_a_contact_that_lasts_by_a_latched_rate_is_told(gravity: float, lasts: bool) -> None:
    scene = thrown(pair({"law": "power", "stiffness": 1e9}, {"law": "exact", "restitution": 0.2}))
    scene["gravity"] = [gravity, 0.0]  # impacts of 0.2 m/s come again after 0.1 ms, and die out
    run = finish({"kind": "simulate", "scene": scene, "duration": 0.04, "tolerance": 1e-6})
    assert isinstance(run, Finished)
    assert run.certificate is not None
    note = run.certificate.facts["note"]
    assert (
        "In the second half of the run contact lasted throughout in bearing0 (" in note
    ) == lasts
    assert ("power with exact), with the impact rate that the law latched" in note) == lasts


@pytest.mark.long
@pytest.mark.parametrize(("modulus", "told"), [(1e6, True), (1e9, False)])
def test_contacts_deeper_than_the_formula_of_their_law_are_told(modulus: float, told: bool) -> None:
    rubber = {"law": "johnson", "youngs_modulus": modulus}
    scene = thrown(pair(rubber, {"law": "exact", "restitution": 0.5}))
    run = finish({"kind": "simulate", "scene": scene, "duration": 0.02, "tolerance": 1e-5})
    assert isinstance(run, Finished)
    assert run.certificate is not None
    note = run.certificate.facts["note"]
    assert ("deeper than their law's formula goes (bearing0.penetration " in note) == told
