"""The report of where the tests' time goes."""

import json
import subprocess
import sys
from dataclasses import asdict
from pathlib import Path

from tests.times import Spent, dearest

ROOT = Path(__file__).parents[1]
BUSY = "import time; [None for _ in iter(lambda: time.process_time() < 0.5, False)]"
TESTS = f"""
import subprocess, sys, time

def test_here():
    begun = time.process_time()
    while time.process_time() < begun + 0.1:
        pass

def test_elsewhere():
    subprocess.run([sys.executable, "-c", {BUSY!r}], check=True)
"""


def test_files_have_their_tests_processes_and_seconds(tmp_path: Path) -> None:
    (tmp_path / "test_some.py").write_text(TESTS)
    (tmp_path / "test_other.py").write_text("def test_none(): assert True")
    times = tmp_path / "build" / "times.json"
    command = [sys.executable, "-m", "pytest", "-p", "tests.times", "--times", str(times)]
    subprocess.run([*command, str(tmp_path)], check=True, cwd=ROOT, capture_output=True)
    found = {Path(name).name: Spent(**one) for name, one in json.loads(times.read_text()).items()}
    some, other = found["test_some.py"], found["test_other.py"]
    assert (some.tests, some.processes, other.tests, other.processes) == (2, 1, 1, 0)
    assert some.processor >= 0.1 + 0.5 - 0.02  # of both processes, by clocks of 10 ms
    assert other.processor < some.processor
    assert some.seconds >= 0.1


def test_the_dearest_come_first_and_all_are_added() -> None:
    files = {f"test_{i}.py": asdict(Spent(i, 2 * i, 0.0, 1, 3)) for i in (2, 30, 4)}
    head, first, second, total = dearest(files, 2).splitlines()
    assert head.split()[-1] == "file"
    assert first.split() == ["30.0", "60.0", "0.0", "1", "3", "test_30.py"]
    assert second.split()[-1] == "test_4.py"
    assert total.split()[:5] == ["36.0", "72.0", "0.0", "3", "9"]
