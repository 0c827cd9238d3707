"""Contacts that steps make, not the motion: the certificate says so."""

from typing import Any

import pytest

from benchmarks.lies.run import Finished, finish
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
    assert bool(facts["note"]) == chatters


@pytest.mark.parametrize(
    ("law", "latched"),
    [({"law": "exact", "restitution": 0.2}, True), ({"law": "kuwabara-kono"}, False)],
)
def test_a_contact_that_lasts_by_a_latched_rate_is_told(law: dict[str, Any], latched: bool) -> None:
    damping = law if latched else law | {"relaxation_time": 1e-4}
    scene = thrown(pair({"law": "power", "stiffness": 1e9}, damping))
    scene["gravity"] = [2000.0, 0.0]  # impacts of 0.2 m/s come again after 0.1 ms, and die out
    run = finish({"kind": "simulate", "scene": scene, "duration": 0.04, "tolerance": 1e-6})
    assert isinstance(run, Finished)
    assert run.certificate is not None
    note = run.certificate.facts["note"]
    told = "In the second half of the run contact lasted throughout in bearing0 ("
    assert (told in note) == latched
    assert ("power with exact), with the impact rate that the law latched" in note) == latched
