"""Values that the publication prints, as the report takes them."""

import math

import pytest

from jointplay.paper import reported
from jointplay.solver.scene import presets
from tests.paper.printed_numbers import pointers as printed_numbers


def test_settings_become_parameters_in_si():
    entry = {"clearance_mm": 0.3, "friction": 0.05, "omega_over_pi": 1.5}
    assert reported.parameters(entry) == {
        "clearance": 0.0003,  # exactly what a user would write
        "friction": 0.05,
        "speed": pytest.approx(1.5 * math.pi, rel=1e-14),
    }


def test_a_case_is_named_by_its_settings():
    entry = {"clearance_mm": 0.5, "friction": 0.1, "omega_over_pi": 1.0}
    assert reported.case_name(entry) == "0.5 mm, friction 0.1, π rad/s"


def test_pointers_are_those_of_numbers_and_not_of_settings():
    pointers = printed_numbers()
    assert "/response_peaks/0/force_A/1" in pointers
    assert "/test_bed/3/cycle30_theory" in pointers
    assert not any("clearance" in pointer or "rpm" in pointer for pointer in pointers)
    # 1 stroke, 39 of responses, 6 of the two programs, 32 ends of ranges, 12 of the experiment
    assert len(pointers) == 90


def test_the_scene_reports_the_same_numbers():
    """Two documents hold them: the scene those of its demonstration, this one all."""
    printed = reported.document()
    keys = {"displacement": ("displacement_mm", 1e-3), "acceleration": ("acceleration", 1.0)}
    keys |= {f"{joint}.normal_force": (f"force_{joint}", 1.0) for joint in "AB"}
    entries = presets.document(printed["scene"])["reported"]
    assert entries
    for entry in entries:
        if entry["parameters"]["clearance"] == 0.0:
            here = 1e-3 * printed["ideal"]["displacement_peak_mm"]
        else:
            (found,) = [
                one
                for one in printed["response_peaks"]
                if entry["parameters"].items() <= reported.parameters(one).items()
                and one["omega_over_pi"] == 1.0
            ]
            key, factor = keys[entry["channel"]]
            value = found[key][0] if isinstance(found[key], list) else found[key]
            here = factor * value
        assert here == pytest.approx(entry["value"], rel=1e-12)
