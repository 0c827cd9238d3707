"""Certificates of runs that once had more certified than was so."""

from typing import Any

import numpy as np
import pytest

from jointplay.records.failure import SimulationFailed
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.runs.certificate.certificate import Certificate
from jointplay.solver.runs.simulate import Simulation
from tests.solver.runs.certificate.doubtful_jobs import (
    BRISTLES,
    FAILS,
    GUIDE,
    LEG,
    ROTOR,
    SLOT,
)

Onsets = list[np.ndarray]


def computed(job: dict[str, Any]) -> tuple[Certificate, Onsets, str]:
    """Return a run's certificate, the onsets of its pairs, s, and the code of its failure."""
    admission = admit(job)
    assert isinstance(admission, Admission)
    simulation, impacts, code = Simulation(admission), [], ""
    try:
        impacts.extend(piece.impacts for piece in simulation.slices())
    except SimulationFailed as failure:
        code = failure.code
    found = simulation.certificate()
    assert found is not None
    every = np.concatenate(impacts)
    pairs = range(int(every["joint"].max(initial=0)) + 1)
    return found, [np.sort(every["onset"][every["joint"] == pair]) for pair in pairs], code


def assert_known(found: Certificate, own: Onsets, true: Onsets) -> None:
    """The certified contacts are those of the truth, within the error of their onsets."""
    impacts = found.facts["impacts"]
    until, error = impacts["until"], impacts["onset_error"]
    for one, other in zip(own, true, strict=True):
        one, other = (onsets[onsets <= until] for onsets in (one, other))
        assert len(one) == len(other)
        assert np.all(np.abs(one - other) <= error)
    assert impacts["certified"] == sum(int((onsets <= until).sum()) for onsets in own)
    assert impacts["count"] == sum(map(len, own))


def test_play_in_a_guide_is_known_no_longer_than_its_corners_are() -> None:
    """By the independent integration the order of contacts is another one from 27.6 ms on."""
    found, own, _ = computed(GUIDE)
    facts = found.facts
    assert 0.015 < facts["horizon"] < 0.0276
    assert facts["impacts"]["until"] <= facts["horizon"]
    assert 0 < facts["impacts"]["certified"] < facts["impacts"]["count"] == sum(map(len, own))
    assert "how many follow, and when, is what the trajectory's steps made of it" in facts["note"]


def test_contacts_in_a_slot_are_certified_as_long_as_they_are_the_motion_s() -> None:
    """By the independent integration there are 68; at the job's own tolerance there are more."""
    found, own, _ = computed(SLOT)
    impacts = found.facts["impacts"]
    assert impacts["count"] == sum(map(len, own)) > 68
    assert 10 <= impacts["certified"] < 68
    assert impacts["until"] < found.facts["horizon"]  # the motion itself is known to the end
    assert f"{impacts['certified']} of {impacts['count']}" in found.facts["note"]
    true = computed(SLOT | {"accuracy": "fine", "certificate": True})[1]
    assert sum(map(len, true)) == 68
    assert_known(found, own, true)


def failed() -> Certificate:
    """Return the certificate of a run that failed: rounding decides at which speed, and where."""
    for speed in range(29, 37):
        scene = {**FAILS["scene"], "parameters": {"speed": -float(speed)}}
        found, _, code = computed(FAILS | {"scene": scene})
        own, *others = [lane["time"] for lane in found.facts["lanes"]]
        if code and own < max(others):
            assert code == "step-size-underflow"
            return found
    raise AssertionError("no run failed whose companions came further")


def test_a_run_that_failed_is_certified_no_longer_than_it_ran() -> None:
    found = failed()
    facts, end = found.facts, found.facts["lanes"][0]["time"]
    assert 0.0 < end < FAILS["duration"]
    assert found.time[-1] <= end
    assert 0.8 * end < facts["horizon"] <= end
    assert max(max(span) for span in facts["converged"]) <= end
    assert found.until.max() <= end
    assert all(facts["lanes"][lane]["time"] <= end for lane in facts["lanes_with_extremes"])
    assert facts["impacts"] is None  # nothing can touch


@pytest.mark.parametrize(
    ("job", "least", "most"),
    [
        pytest.param(BRISTLES, 50.0, 1000.0, id="bristles", marks=pytest.mark.long),
        pytest.param(ROTOR, 50.0, 1000.0, id="rotor"),
        pytest.param(FAILS, 0.0, 10.0, id="bars"),
    ],
)
def test_what_the_energy_ledger_lacks_is_told_in_tolerances(
    job: dict[str, Any], least: float, most: float
) -> None:
    found, _, _ = computed(job)
    facts = found.facts
    tolerance = facts["lanes"][0]["tolerance"]
    lacking = abs(facts["energy_residual"]) / (tolerance * facts["gross_work"])
    assert facts["energy_in_tolerances"] == pytest.approx(lacking)
    assert least < lacking < most
    assert (f"lacks {lacking:.3g} times the tolerance" in facts["note"]) == (lacking > 10.0)


@pytest.mark.long
def test_a_contact_that_only_the_trajectory_has_is_inside_its_bar() -> None:
    """The second contact begins at 0.362640 ms by the independent integration, to 1e-14."""
    late = []
    for tolerance in (2e-6, 1e-6, 5e-7):
        found, (own,), _ = computed(LEG | {"tolerance": tolerance})
        late.append(abs(own[1] - 0.362640e-3))
        assert found.facts["impacts"]["onset_error"] >= late[-1]
        twin = found.facts["lanes"][7]
        assert twin["steps"] == found.facts["lanes"][0]["steps"]  # closed loops and all
    assert max(late) > 1e-7  # one is unlucky: which, rounding decides
