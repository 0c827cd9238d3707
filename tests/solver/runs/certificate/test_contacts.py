"""Contacts that steps make, not the motion: the certificate says so."""

import pytest

from benchmarks.lies.run import Finished, finish


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
