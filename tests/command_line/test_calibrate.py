"""``jointplay calibrate`` from its options or a document, and what it prints and writes."""

import json
import signal
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest
from filelock import FileLock

from jointplay import progress
from jointplay.command_line.calibrate import computed
from jointplay.command_line.exits import Exit
from jointplay.solver.kinds import admit, admit_calibration
from jointplay.worker.local.measured import Measured
from tests.waiting import until

FORCE = "bearing.normal_force@0:0.018"
BOUNCE = ["bouncing-journal", "--set", "friction=0", "--set", "restitution=1"]
FIT = ["--fit", "stiffness=1e8:1e11:log"]
QUICK = ["--population", "8", "--generations", "20", "--processes", "1"]
WANTED = 833.93  # N: what a stiffness of 5e9 gives, by conservation of energy


@pytest.fixture
def document(tmp_path: Path) -> Path:
    """A calibration with a number that is only shown."""
    force = {"channel": "bearing.normal_force", "to": 0.018}
    path = tmp_path / "calibration.json"
    path.write_text(
        json.dumps(
            {
                "kind": "calibration",
                "scene": {"preset": "bouncing-journal", "parameters": {"friction": 0.0}},
                "parameters": {
                    "stiffness": {"minimum": 1e8, "maximum": 1e11, "spacing": "log"},
                    "mass": {"minimum": 0.8, "maximum": 1.25},
                },
                "cases": [
                    {
                        "name": "falls from the centre",
                        "parameters": {"restitution": 1.0},
                        "targets": [
                            {**force, "value": WANTED},
                            {**force, "statistic": "maximum_time", "value": 0.0146, "weight": 0.0},
                        ],
                    }
                ],
                "search": {"population": 5, "generations": 10},
                "spread": {"generations": 12},
            }
        )
    )
    return path


@pytest.mark.long
def test_the_time_that_is_left_is_told_from_when_the_kernels_are_prepared(document, monkeypatch):
    told = []
    recorder = contextmanager(lambda title: iter([lambda share, note: told.append((share, note))]))
    monkeypatch.setattr(progress, "progress", recorder)
    computed(admit_calibration(json.loads(document.read_text())), processes=1)
    assert told[:2] == [(0.0, "preparing the kernels"), (0.0, "searching")]
    assert told[2][0] > 0.0


@pytest.mark.long
def test_a_preset_is_fitted_to_a_number_that_is_typed(jointplay):
    ended = jointplay("calibrate", *BOUNCE, *FIT, "--target", f"{FORCE}={WANTED}", *QUICK)
    assert ended.code == 0, ended.err
    table, parameters, notes = ended.out.split("\n\n")
    assert "maximum of bearing.normal_force [N]" in table
    assert "833.93" in table
    name, fitted = parameters.splitlines()[1].split()[:2]
    assert name == "stiffness"
    assert float(fitted) == pytest.approx(5e9, rel=0.02)  # a miss of 0.1 tolerances is 0.5 % of F
    assert "fits equally well" in notes


def test_a_document_is_fitted_and_what_is_left_is_repeated_bit_for_bit(
    jointplay, document, tmp_path
):
    found, again = tmp_path / "found.json", tmp_path / "again.json"
    ended = jointplay("calibrate", document, "-o", found, "--processes", "1")
    assert ended.code == 0, ended.err
    assert "falls from the centre" in ended.out
    assert "not fitted" in ended.out
    assert "stiffness and mass make up for one another" in ended.out
    assert "reaches its minimum and maximum" in ended.out
    assert "'lowest to highest' has the true value in 68 % of the cases" in ended.out
    ended = jointplay("calibrate", found, "-o", again, "--processes", "2", "--json")
    assert ended.code == 0, ended.err
    assert again.read_bytes() == found.read_bytes()
    assert json.loads(ended.out) == json.loads(found.read_text())
    other = tmp_path / "other.json"
    other_seed = ["-o", other, "--seed", "1", "--processes", "1"]
    assert jointplay("calibrate", document, *other_seed).code == 0
    assert json.loads(other.read_text())["members"] != json.loads(found.read_text())["members"]


def test_the_scene_that_is_written_has_what_was_found_as_its_defaults(
    jointplay, document, tmp_path
):
    scene, found = tmp_path / "my_fitted.json", tmp_path / "found.json"
    ended = jointplay("calibrate", document, "--preset-out", scene, "-o", found, "--processes", "1")
    assert ended.code == 0, ended.err
    written = json.loads(scene.read_text())
    best = {row["name"]: row["best"] for row in json.loads(found.read_text())["parameters"]}
    assert written["name"] == "my-fitted"
    for name, value in best.items():
        assert written["parameters"][name]["default"] == value
        assert written["parameters"][name]["inferred"] is True
    assert written["parameters"]["friction"]["default"] == 0.0
    assert (
        "Inferred: stiffness, mass, by a fit to 1 number of bearing.normal_force"
        in written["description"]
    )
    shown = jointplay("scene", "check", scene)
    assert shown.code == 0, shown.err
    admitted = admit({"kind": "simulate", "scene": written, "duration": 0.01})
    assert admitted.scene.bodies["journal"].mass == best["mass"]


BAD = {
    "nothing may move": ([*BOUNCE, "--target", f"{FORCE}=1"], "--fit NAME=MIN:MAX"),
    "half a range": ([*BOUNCE, "--fit", "stiffness=1e8"], "write NAME=MIN:MAX"),
    "no number": ([*BOUNCE, "--fit", "stiffness=low:high"], "'low' is not a number"),
    "no reported numbers": ([*BOUNCE, *FIT], "give --target"),
    "no window": ([*BOUNCE, *FIT, "--target", "height=0"], "--duration"),
    "unknown statistic": ([*BOUNCE, *FIT, "--target", "height:mean@0:1=0"], ":minimum"),
    "unknown parameter": (
        [*BOUNCE, "--fit", "stifness=1:2", "--target", f"{FORCE}=1"],
        "/parameters/stifness: There is no parameter",
    ),
    "unknown channel": ([*BOUNCE, *FIT, "--target", "heigth@0:1=2"], "did you mean 'height'"),
    "no such file": (["nothing.json", *FIT], "There is no file"),
    "unknown preset": (["press", *FIT, "--target", f"{FORCE}=1"], "/scene/preset"),
}


@pytest.mark.parametrize(("arguments", "sentence"), BAD.values(), ids=BAD)
def test_bad_usage_ends_with_two_and_a_line(jointplay, arguments, sentence):
    ended = jointplay("calibrate", *arguments)
    assert ended.code == 2, ended.err
    assert sentence in ended.line()


def test_another_document_is_refused(jointplay, tmp_path):
    job = tmp_path / "job.json"
    job.write_text(json.dumps({"kind": "simulate", "scene": {"preset": "pendulum"}}))
    ended = jointplay("calibrate", job, *FIT)
    assert ended.code == 2
    assert "/kind: 'kind' must be 'calibration'" in ended.line()


def test_targets_of_a_document_are_not_replaced(jointplay, document):
    ended = jointplay("calibrate", document, "--target", f"{FORCE}=1")
    assert ended.code == 2
    assert "has its targets already" in ended.line()


def test_a_signal_ends_it_and_says_how_to_go_on(jointplay, tmp_path):
    found = tmp_path / "found.json"
    measured = tmp_path / "found.json.measured"
    long = [*BOUNCE, *FIT, "--target", f"{FORCE}={WANTED}", "--generations", "10000"]
    begin = [sys.executable, "-m", "jointplay", "calibrate", *long, "--population", "500"]
    with subprocess.Popen(
        [*begin, "-o", found, "--processes", "1"], stderr=subprocess.PIPE, text=True
    ) as process:
        until(lambda: process.poll() is not None or measured.exists())
        process.send_signal(signal.SIGTERM)
        _, told = process.communicate()
    assert process.returncode == Exit.INTERRUPTED
    assert told.splitlines()[-1].endswith(f"To go on: jointplay calibrate --resume {found}")
    assert measured.exists()
    nothing = jointplay("calibrate", "--resume", tmp_path / "other.json")
    assert nothing.code == 2
    assert "No calibration was begun" in nothing.line()


def test_what_one_process_measures_no_other_one_changes(jointplay, document, tmp_path):
    found, measured = tmp_path / "found.json", tmp_path / "found.json.measured"
    Measured(measured, admit_calibration(json.loads(document.read_bytes())))
    before = measured.read_bytes()
    with FileLock(tmp_path / "found.json.lock"):
        for how in ([document, "-o", found], ["--resume", found]):
            ended = jointplay("calibrate", *how, "--processes", "1")
            assert ended.code == 2
            assert "Another process calibrates for" in ended.line()
    assert measured.read_bytes() == before


@pytest.mark.long
def test_a_calibration_that_was_begun_is_ended(jointplay, document, tmp_path):
    found, again = tmp_path / "found.json", tmp_path / "again.json"
    begun = admit_calibration(json.loads(document.read_bytes()))
    Measured(tmp_path / "found.json.measured", begun)
    ended = jointplay("calibrate", "--resume", found, "--processes", "1")
    assert ended.code == 0, ended.err
    assert sorted(path.name for path in tmp_path.iterdir()) == ["calibration.json", "found.json"]
    assert jointplay("calibrate", found, "-o", again, "--processes", "1").code == 0
    assert again.read_bytes() == found.read_bytes()
