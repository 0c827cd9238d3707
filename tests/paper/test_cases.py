"""The jobs of a reproduction."""

import math

import pytest

from jointplay.paper import cases, reported
from jointplay.paper.variants import AS_PUBLISHED, FULL, MATERIAL, QUICK
from jointplay.solver.kinds import Admission, admit


@pytest.mark.parametrize("size", [FULL, QUICK], ids=["full", "quick"])
def test_every_job_is_admitted_under_a_name_of_its_own(size):
    runs = [*cases.runs(size), *cases.kernels(size)]
    assert len({run.name for run in runs}) == len(runs)
    for run in runs:
        assert admit(run.job).job["kind"] == run.job["kind"]
        assert run.weight > 0.0


def test_samples_fall_on_the_grid_of_the_publication():
    stride = reported.document()["grid"] / cases.STEP
    assert stride == round(stride)
    run = next(one for one in cases.runs(FULL) if one.name.startswith("response-"))
    admitted = admit(run.job)
    assert isinstance(admitted, Admission)
    assert admitted.job["output_step"] == cases.STEP


def test_both_slip_velocities_are_computed_for_every_figure():
    for kind in ("response", "gravity", "ranges", "portrait", "settled", "diagram"):
        chosen = {
            run.job["scene"]["parameters"]["slip_velocity"]
            for run in cases.runs(FULL)
            if run.name.startswith(kind)
        }
        assert chosen == {MATERIAL.name, AS_PUBLISHED.name}


def test_diagrams_have_values_at_every_printed_edge():
    for entry in reported.document()["bifurcation"]:
        values = cases.values(entry, FULL)
        edges = {edge for words in entry["reported"] for edge in words["interval"]}
        for edge in edges:
            wanted = reported.si(entry["parameter"], edge)
            assert min(abs(value / wanted - 1.0) for value in values) < 1e-12


def test_quick_diagrams_reach_from_end_to_end_too():
    for entry in reported.document()["bifurcation"]:
        values = cases.values(entry, QUICK)
        ends = [reported.si(entry["parameter"], edge) for edge in entry["interval"]]
        assert [values[0], values[-1]] == ends
        assert 3 <= len(values) <= 12


def test_gravity_is_reversed_and_switched_off_for_the_comparison_of_programs():
    gravities = {
        run.name.split("-")[1]: run.job["scene"]["parameters"]["gravity_x"]
        for run in cases.runs(QUICK)
        if run.name.startswith("gravity-")
    }
    assert gravities == {"forward": 9.81, "reversed": -9.81, "absent": 0.0}


def test_a_revolution_at_the_slowest_speed_fits_into_the_response():
    slowest = min(entry["omega_over_pi"] for entry in reported.document()["response_peaks"])
    assert 2.0 * math.pi / (slowest * math.pi) <= cases.DURATION
