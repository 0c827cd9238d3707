"""Certificates claim nothing beyond what was kept of contacts, nor beyond the end of the run."""

from typing import Any

import pytest

from jointplay.solver.kinds import admit
from jointplay.solver.runs.certificate import companions
from jointplay.solver.runs.certificate.growth import Windows
from jointplay.solver.runs.dynamic_run import DynamicRun
from tests.solver.laws.thrown import pair, thrown

HARD = pair({"law": "power", "stiffness": 1e9}, {"law": "exact", "restitution": 0.5})


def run_of(duration: float) -> DynamicRun:
    job = {"kind": "simulate", "scene": thrown(HARD), "duration": duration, "certificate": True}
    return DynamicRun(admit(job | {"method": "tsitouras"}))


def impacts(run: DynamicRun) -> dict[str, Any]:
    for _ in run.slices():
        pass
    certificate = run.certificate()
    assert certificate is not None
    return certificate.facts["impacts"]


def test_contacts_that_were_not_kept_are_not_certified(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = impacts(run_of(0.02))
    assert whole["certified"] == whole["count"] == 2
    monkeypatch.setattr(companions, "MOST_CONTACTS", 1)
    first = impacts(run_of(0.02))
    assert (first["certified"], first["count"]) == (1, 2)
    assert first["until"] < 0.0138  # where the second begins


def test_growth_is_not_followed_beyond_where_a_run_was_broken_off() -> None:
    run = run_of(0.02)
    assert run.survey is not None
    run.survey.advance(30)
    reached = run.bundle.lane(0).time
    assert 0.0 < reached < 0.02
    windows = Windows(run.survey.companions, run.problem, run.survey.tangents)
    while windows.advance(1000):
        pass
    assert 0.0 < windows.times.max() <= reached
