"""Tests that take long on the processor: a seeded share of them in `make test`, all in `test-long`.

    python -m tests.expensive          draws anew, from build/test-times.json and with the next seed

What each took is in `expensive.json`, which is committed: the same tests are left out on every
machine. A test that is not in it is run. Those of `ALWAYS` are what the project promises first, and
are run, whatever they take.
"""

import json
import random
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

TABLE = Path(__file__).with_name("expensive.json")
TIMES = Path(__file__).parents[1] / "build" / "test-times.json"
LEAST = 0.5
"""Seconds of processor from which on a test is expensive."""
SHARE = 0.06
"""Share of the seconds of a folder's expensive tests in which some are run, at least one."""
ALWAYS = ("tests/test_readme.py", "tests/command_line/test_demo.py")


def draw(times: Mapping[str, Mapping[str, float]], seed: int) -> dict[str, Any]:
    """Return the seed, and the seconds of the expensive tests that are left out, by their names."""
    expensive: dict[str, dict[str, float]] = {}
    for name, spent in sorted(times.items()):
        file = name.partition("::")[0]
        if spent["processor"] >= LEAST and file not in ALWAYS:
            folder = "/".join(file.split("/")[:2])
            expensive.setdefault(folder, {})[name] = round(spent["processor"], 1)
    draws, left_out = random.Random(seed), {}
    for tests in expensive.values():
        kept = _kept(tests, draws)
        left_out |= {name: seconds for name, seconds in tests.items() if name not in kept}
    return {"seed": seed, "left_out": left_out}


def _kept(tests: Mapping[str, float], draws: random.Random) -> set[str]:
    """Return the tests of a folder that are run: those drawn that fit, or the shortest of all."""
    room, kept = SHARE * sum(tests.values()), set()
    for name in draws.sample(list(tests), len(tests)):
        if tests[name] <= room:
            kept.add(name)
            room -= tests[name]
    return kept or {min(tests, key=tests.__getitem__)}


def mark(items: list[pytest.Item]) -> None:
    """Mark the expensive tests that `make test` leaves out as long."""
    left_out = json.loads(TABLE.read_text())["left_out"] if TABLE.exists() else {}
    for item in items:
        if item.nodeid in left_out:
            item.add_marker(pytest.mark.long)


def collected() -> set[str]:
    """Return the names of all tests that there are; seconds."""
    command = [sys.executable, "-m", "pytest", "--collect-only", "-m", "long or not long"]
    listed = subprocess.run(command, cwd=TABLE.parents[1], check=True, capture_output=True)
    return set(listed.stdout.decode().splitlines())


def main() -> int:
    """Draw anew, and write the table."""
    before = json.loads(TABLE.read_text()) if TABLE.exists() else {"seed": 0, "left_out": {}}
    times = json.loads(TIMES.read_text())
    known = {name: {"processor": seconds} for name, seconds in before["left_out"].items()}
    there = collected()
    spent = {name: one for name, one in (known | times).items() if name in there}
    table = draw(spent, before["seed"] + 1)
    TABLE.write_text(json.dumps(table, indent=1) + "\n")
    seconds = sum(table["left_out"].values())
    print(f"{len(table['left_out'])} tests of {seconds:.0f} s are left to `make test-long`")
    return 0


if __name__ == "__main__":
    sys.exit(main())
