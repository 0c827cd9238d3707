"""``jointplay demo``: from nothing to figures, and nothing left behind."""

import json
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from jointplay.client import Peak
from jointplay.command_line.demo import cases_of, rows_of, table
from jointplay.service.processes.folder_lock import holding
from jointplay.solver.scene import presets

README = (Path(__file__).parents[2] / "README.md").read_text()
DEMO = [sys.executable, "-m", "jointplay", "demo", "seven-bar-press", "-o"]


def processes_of(folder: Path) -> list[str]:
    """Command lines of all processes that mention the demo's folder."""
    found = []
    for process in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            command = process.read_bytes().replace(b"\0", b" ").decode(errors="replace")
        except OSError:
            continue  # it ended meanwhile
        if str(folder) in command:
            found.append(command)
    return found


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    if not Path("/proc/self/cmdline").exists():  # Linux alone has it
        pytest.skip("needs /proc to see that nothing is left")
    return tmp_path / "demo"


def test_the_demo_prints_every_published_number_beside_ours_and_stops_everything(folder):
    ended = subprocess.run([*DEMO, str(folder), "--json"], capture_output=True, text=True)
    assert ended.returncode == 0, ended.stderr
    reported = presets.document("seven-bar-press")["reported"]
    rows = json.loads(ended.stdout)["comparison"]
    assert len(rows) == len(reported) > 0
    for found, entry in zip(rows, reported, strict=True):
        ours = found["ours"]
        assert found["reported"] == entry["value"]
        if entry["channel"] == "displacement":
            # the source's contact parameters are not known; any plausible ones move it by 0.06 mm
            assert ours == pytest.approx(entry["value"], abs=0.11e-3)  # + half its last digit
            row = re.search(rf"\| {entry['value'] * 1e3:.1f} mm \| ([\d.]+) mm \|", README)
            assert row is not None
            # bounces decide the peak of the smallest clearance: rounding moves it by 0.014 mm
            assert ours * 1e3 == pytest.approx(float(row.group(1)), abs=0.02)
    cases = [path for path in folder.iterdir() if path.name != "service"]
    assert len(cases) == 4
    for case in cases:
        figures = {"mechanism.png", "outputs.png"}
        if case.name != "clearance=0":
            figures |= {"contact-force.png", "orbit.png"}
        assert {path.name for path in case.iterdir()} == figures
        assert (case / "outputs.png").read_bytes().startswith(b"\x89PNG")
    assert processes_of(folder) == []


def test_the_table_has_a_line_for_every_published_number():
    scene = presets.document("seven-bar-press")
    cases = cases_of(scene)
    peaks = [
        {
            entry["channel"]: Peak(entry["value"], 0.0, entry["value"], 0.0, entry["unit"])
            for entry in case.reported
        }
        for case in cases
    ]
    lines = [line for line in table(rows_of(cases, peaks)) if "imum of " in line]
    assert len(lines) == len(scene["reported"])
    for line, entry in zip(lines, scene["reported"], strict=True):
        assert f"{entry['value']:g}" in line
        assert re.split(r"\s{2,}", line)[5] == "1.0000"


def test_the_demo_leaves_what_is_in_its_folder_already(tmp_path):
    data = tmp_path / "service"
    data.mkdir()
    (data / "thesis.txt").write_text("mine")
    refused = subprocess.run([*DEMO, str(tmp_path)], capture_output=True, text=True)
    assert refused.returncode == 2
    assert "holds something else than a service" in refused.stderr
    (data / "catalogue.sqlite").touch()
    with holding(data):  # by a service
        refused = subprocess.run([*DEMO, str(tmp_path)], capture_output=True, text=True)
    assert refused.returncode == 3
    assert "is in use by another" in refused.stderr
    assert (data / "thesis.txt").read_text() == "mine"


@pytest.mark.long
def test_an_interrupted_demo_stops_everything_too(folder):
    with subprocess.Popen(
        [*DEMO, str(folder)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        for line in process.stdout:
            if "submitting" in line:
                break
        assert processes_of(folder) != []
        process.send_signal(signal.SIGINT)
        assert process.wait(60) == 130
        assert process.stderr.read().splitlines()[-1] == "jointplay: interrupted"
    assert processes_of(folder) == []
