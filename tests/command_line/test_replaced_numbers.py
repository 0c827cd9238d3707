"""A number of a scene that a parameter's default replaces is told where its job is admitted."""

import json
from pathlib import Path

import pytest

from jointplay.solver.scene import presets

TOLD = "jointplay: the default of parameter mass puts 1.0 in place of 2.0 at /bodies/rod/mass"


@pytest.fixture
def edited(tmp_path: Path) -> Path:
    """The pendulum with another mass, whose parameter's default stayed."""
    scene = presets.document("pendulum")
    scene["bodies"]["rod"]["mass"] = 2.0
    file = tmp_path / "mine.json"
    file.write_text(json.dumps(scene))
    return file


def test_a_run_tells_it_and_repeats_without_a_word(jointplay, edited, tmp_path):
    ended = jointplay("run", edited, "--duration", "0.01", "-o", tmp_path / "OUT")
    assert ended.code == 0
    assert TOLD in ended.err.splitlines()
    filled = json.loads((tmp_path / "OUT" / "job.json").read_text())
    assert filled["scene"]["bodies"]["rod"]["mass"] == 1.0
    again = jointplay("run", tmp_path / "OUT" / "job.json", "-o", tmp_path / "AGAIN")
    assert again.code == 0
    assert "in place of" not in again.err


def test_a_submission_and_an_estimate_tell_it(jointplay, edited, service_url):
    typed = [edited, "--duration", "0.01", "--url", service_url]
    assert jointplay("submit", *typed).lines() == [TOLD]
    assert jointplay("submit", *typed, "--estimate").lines() == [TOLD]


def test_a_batch_tells_it_once(jointplay, edited, service_url, tmp_path):
    scene = json.loads(edited.read_text())
    job = {"kind": "simulate", "scene": scene, "duration": 0.01}
    sweep = {"kind": "sweep", "scene": scene, "grid": {"mass": [1.0, 2.0]}, "duration": 0.01}
    batch = tmp_path / "batch.json"
    batch.write_text(json.dumps([job, job | {"duration": 0.02}, sweep]))
    ended = jointplay("batch", batch, "--url", service_url)
    assert ended.err.splitlines() == [TOLD.replace("the", "in 2 of 3 jobs the", 1)]


@pytest.mark.parametrize(
    "typed",
    [
        ["--duration", "0.01", "--set", "mass=3"],
        ["--duration", "0.01", "--sweep", "mass=1,2"],
    ],
)
def test_what_is_set_or_varies_is_known(jointplay, edited, service_url, typed):
    ended = jointplay("submit", edited, *typed, "--url", service_url)
    assert (ended.code, ended.err) == (0, "")
