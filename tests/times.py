"""Where the tests' processor time goes, test by test: `pytest -p tests.times --times FILE`.

Processor seconds are those of pytest and of all processes that it started, whether these have ended
or not: what a service takes that several tests share is that of those which make it work. What it
takes to set up a fixture that several tests share is no test's: it has a row of its own, named
after the file of the first test that asked for it.
"""

import json
import os
import sys
import time
from collections.abc import Iterator, Mapping
from dataclasses import asdict, astuple, dataclass
from pathlib import Path

import pytest


@dataclass
class Spent:
    """Costs of the tests of a file, or of all tests until now."""

    processor: float = 0.0
    """Seconds of processor."""
    seconds: float = 0.0
    """Seconds by the clock."""
    compiling: float = 0.0
    """Seconds of processor of pytest itself for kernels that were not compiled yet."""
    processes: int = 0
    """Processes that were started."""
    tests: int = 0

    def __add__(self, other: "Spent") -> "Spent":
        """Return the sum of both."""
        return Spent(*(one + more for one, more in zip(astuple(self), astuple(other), strict=True)))

    def __sub__(self, other: "Spent") -> "Spent":
        """Return what was spent since."""
        return Spent(*(one - less for one, less in zip(astuple(self), astuple(other), strict=True)))


def processor() -> float:
    """Return the processor seconds of this process and of all that it started, living or not."""
    ticks, waiting = 0, [os.getpid()]
    while waiting:
        process = Path(f"/proc/{waiting.pop()}")
        try:
            ticks += sum(map(int, (process / "stat").read_text().rpartition(")")[2].split()[11:15]))
            for task in (process / "task").iterdir():
                waiting += map(int, (task / "children").read_text().split())
        except OSError:
            continue  # it has ended
    return ticks / os.sysconf("SC_CLK_TCK") if ticks else sum(os.times()[:4])


class Times:
    """Notes what each test takes, and writes it in the end."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._spent: dict[str, Spent] = {}
        self._shared = Spent()
        """Costs of all shared fixtures until now."""
        self._file = ""
        self._setting_up = False
        """Whether a shared fixture is being set up, and maybe asks for others."""
        self._tests = self._processes = 0
        self._processor = self._lost = 0.0
        sys.addaudithook(self._hear)

    def _hear(self, event: str, _: object) -> None:
        self._processes += event == "subprocess.Popen"

    def _until_now(self) -> Spent:
        cache = sys.modules.get("jointplay.solver.kernels.cache")  # not for those who need none
        compiling = 0.0 if cache is None else cache.SPENT.seconds
        now = processor()
        self._lost += max(0.0, self._processor - now)  # by processes whose parent did not wait
        self._processor = now
        spent = now + self._lost
        return Spent(spent, time.monotonic(), compiling, self._processes, self._tests)

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        """Add what a test takes, its fixtures included."""
        before, shared = self._until_now(), self._shared
        self._tests += 1
        self._file = item.nodeid.partition("::")[0]
        result = yield
        self._spent[item.nodeid] = self._until_now() - before - (self._shared - shared)
        return result

    @pytest.hookimpl(wrapper=True)
    def pytest_fixture_setup(self, fixturedef: pytest.FixtureDef[object]) -> Iterator[None]:
        """Add what a fixture takes that several tests share, those it asks for included."""
        if fixturedef.scope == "function" or self._setting_up:
            return (yield)
        before = self._until_now()
        self._setting_up = True
        try:
            return (yield)
        finally:
            self._setting_up = False
            spent = self._until_now() - before
            self._shared += spent
            name = f"{self._file}::{fixturedef.argname}"
            self._spent[name] = self._spent.get(name, Spent()) + spent

    def pytest_unconfigure(self) -> None:
        """Write the tests' times."""
        self._path.parent.mkdir(parents=True, exist_ok=True)
        self._path.write_text(json.dumps({name: asdict(one) for name, one in self._spent.items()}))


def pytest_addoption(parser: pytest.Parser) -> None:
    """Take the file to write."""
    parser.addoption("--times", type=Path, help="write where the processor's time goes")


def pytest_configure(config: pytest.Config) -> None:
    """Measure where it is asked for."""
    if path := config.getoption("times"):
        config.pluginmanager.register(Times(path))


def most_expensive(tests: Mapping[str, Mapping[str, float]], count: int = 25) -> str:
    """Return a table of the files that take most of the processor, and of all together."""
    files: dict[str, Spent] = {}
    for name, one in tests.items():
        file = name.partition("::")[0]
        files[file] = files.get(file, Spent()) + Spent(**one)  # type: ignore[arg-type]
    ordered = sorted(files.items(), key=lambda named: -named[1].processor)
    rows = [*ordered[:count], (f"all {len(files)} files", sum(files.values(), Spent()))]
    head = "processor  seconds  compiling  processes  tests  file"
    return "\n".join([head, *(_row(name, one) for name, one in rows)])


def _row(name: str, one: Spent) -> str:
    return (
        f"{one.processor:9.1f} {one.seconds:8.1f} {one.compiling:10.1f}"
        f" {one.processes:10.0f} {one.tests:6.0f}  {name}"
    )
