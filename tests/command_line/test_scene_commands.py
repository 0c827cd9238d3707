"""``jointplay scene``: look at mechanisms before they are run."""

import json

import pytest

from solver import presets


@pytest.mark.parametrize("name", presets.names())
def test_every_preset_is_listed_shown_and_passes_its_check(jointplay, name):
    assert name in jointplay("scene", "list").out
    shown = jointplay("scene", "show", name).out
    assert all(parameter in shown for parameter in presets.document(name)["parameters"])
    checked = jointplay("scene", "check", name)
    assert checked.code == 0
    assert "degrees of freedom" in checked.out
    assert "assembly residual" in checked.out


def test_a_shown_document_can_be_checked_with_parameters_set(jointplay, tmp_path):
    file = tmp_path / "mine.json"
    file.write_text(jointplay("scene", "show", "slider-crank", "--json").out)
    assert json.loads(file.read_text()) == presets.document("slider-crank")
    assert jointplay("scene", "check", file, "--set", "clearance=1e-4").code == 0
    ended = jointplay("scene", "check", file, "--set", "clearence=1e-4")
    assert ended.code == 2
    assert "clearence" in ended.line()


@pytest.mark.parametrize("form", ["png", "svg"])
def test_a_mechanism_is_drawn(jointplay, tmp_path, form):
    file = tmp_path / f"press.{form}"
    assert jointplay("scene", "draw", "seven-bar-press", "-o", file).code == 0
    start = file.read_bytes()[:1000]
    assert start.startswith(b"\x89PNG") if form == "png" else b"<svg" in start
