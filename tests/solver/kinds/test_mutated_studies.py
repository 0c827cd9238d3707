"""Whatever a document says, it is admitted or refused with a place: nothing else happens."""

import copy
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import admit
from jointplay.solver.runs.study.plan import Study
from tests.solver.runs.study.jobs_of_studies import (
    ACCURACY_STUDY,
    BIFURCATION,
    ENSEMBLE,
    POINCARE,
    SWEEP,
)

SOUND: list[dict[str, Any]] = [
    {**BIFURCATION, "continuation": "both", "chains": 2, "settle": "auto", "observables": ["A.*"]},
    {**BIFURCATION, "values": {"from": 1e-4, "to": 1e-3, "count": 5, "spacing": "log"}},
    {**POINCARE, "section": {"onset": "A"}, "indicators": ["lyapunov"]},
    {**POINCARE, "section": {"channel": "A.eccentricity_x", "value": 1e-4, "direction": "up"}},
    {**ENSEMBLE, "spread": 1e-3, "seed": 1},
    {**ACCURACY_STUDY, "duration": 0.5, "methods": ["rodas", "rk4"], "tolerances": [1e-4, 1e-6]},
    {**SWEEP, "settle": 0.5, "channels": ["displacement"]},
    {
        "kind": "sweep",
        "scene": {"preset": "pendulum"},
        "points": [{"angle": 0.1, "mass": 1.0}],
        "duration": 1.0,
    },
]
ODD = [
    *(None, True, "", "auto", "all", "A", "clearance", "slip_velocity", [], {}, [[]], {"a": 1}),
    *(0, -1, 1, 8, 10**6, 10**11, 10**30, 0.0, -0.0, 1.5, 1e-300, 1e300, 5e-324),
    *(float("nan"), float("inf"), "\ud800", "~/", "é", "x" * 300),
]


@st.composite
def mutated(draw: st.DrawFn) -> Any:
    """A sound document with one to three places replaced, removed or added."""
    document = copy.deepcopy(draw(st.sampled_from(SOUND)))
    for _ in range(draw(st.integers(1, 3))):
        node: Any = document
        while True:
            if isinstance(node, dict):
                places: list[Any] = [*node, "more"]
            else:
                places = list(range(len(node)))
            if not places:
                break
            place = draw(st.sampled_from(places))
            inner = node.get(place) if isinstance(node, dict) else node[place]
            if isinstance(inner, dict | list) and draw(st.booleans()):
                node = inner
                continue
            if draw(st.integers(0, 4)) == 0 and place != "more":
                del node[place]
            else:
                node[place] = copy.deepcopy(draw(st.sampled_from(ODD)))
            break
    return document


@given(mutated())
def test_a_mutated_study_is_admitted_or_refused_with_a_place(document: Any) -> None:
    found = admitted(document)
    if isinstance(found, Study):
        again = admit(found.job)
        assert isinstance(again, Study)
        assert again.digest == found.digest
        assert found.points == len(found.structure) == len(found.duration)
        assert sum(count for _, count in found.blocks) == found.points
    elif isinstance(found, InvalidInput):
        assert found.problems
        for pointer, detail in found.problems:
            assert pointer == "" or pointer.startswith("/")
            assert detail.endswith((".", "?"))


def admitted(document: Any) -> object:
    try:
        return admit(document)
    except InvalidInput as error:
        return error
