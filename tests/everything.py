"""Everything that `make test` and `make test-long` check, six steps side by side, with their times.

The integration loop is compiled first, by one step for all tests: each would compile it for itself.

Run as ``python -m tests.everything [--long] [STEP ...]``; without a step, all of them. With
``--long`` these are the tests that take longer, and no checks of the code. A third of the tests
wait (for leases, restarts, shutdowns) while the others compute. Processor seconds are those of the
processes that ended before the step did. Those of each file of tests are in build/test-times.json;
the most expensive files are printed.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, field, replace
from pathlib import Path
from threading import Event

from tests.times import most_expensive

ROOT = Path(__file__).resolve().parent.parent
GROUPS = (
    ("storage", "deployment", "service"),
    ("faults",),
    ("solver/runs",),
    ("figures", "command_line"),
    ("solver", "seams"),
    ("worker",),
    ("page",),
)
"""Folders of tests that share a process, the longest first, so that none is left alone at the end:
some wait, some compute. All other tests share one, too: each process imports for three seconds. A
service that tests of a folder share lives until its process ends: such a folder is the last one.
"""
ENVIRONMENT = {
    name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"
}
"""Without bytecode every process that a test starts would translate our sources again."""
TIMES = ROOT / "build" / "test-times.json"
LONG_TIMES = ROOT / "build" / "long-times.json"
_COUNTS = re.compile(r"(\d+) (passed|failed|errors?|skipped)\b")


@dataclass
class Step:
    """One command and how it ended."""

    name: str
    command: list[str]
    counts: Counter[str] = field(default_factory=Counter)
    seconds: float = 0.0
    processor: float = 0.0
    failed: bool = False
    output: str = ""
    times: Path | None = None
    """File that pytest writes: what each file of tests took."""
    after: Event | None = None
    """Happens before the command is run."""
    ended: Event = field(default_factory=Event)

    def run(self) -> "Step":
        """Run the command; remember its output, time, outcome and pytest's counts."""
        if self.after is not None:
            self.after.wait()
        print(f"{self.name} ...", flush=True)
        if self.times is not None:
            self.times.unlink(missing_ok=True)
        start = time.monotonic()
        with tempfile.TemporaryFile("w+", errors="replace") as output:
            process = subprocess.Popen(
                self.command, cwd=ROOT, env=ENVIRONMENT, stdout=output, stderr=output
            )
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            output.seek(0)
            self.output = output.read()
        self.seconds = time.monotonic() - start
        self.processor = usage.ru_utime + usage.ru_stime
        self.failed = process.returncode != 0
        last = self.output.rstrip().rpartition("\n")[2]
        for number, outcome in _COUNTS.findall(last):
            self.counts["failed" if outcome.startswith("error") else outcome] += int(number)
        if self.failed and not self.counts["failed"]:
            self.counts["failed"] = 1  # a check, or a pytest that broke off
        self.ended.set()
        return self


def steps(*, long: bool) -> list[Step]:
    """Return the checks of the code, then the tests: what has no group of its own, the groups.

    Of `long` tests no checks of the code.
    """
    bin_folder = Path(sys.executable).parent
    tests = ROOT / "tests"
    files = {path.relative_to(tests).parts[0] for path in tests.rglob("test_*.py")}
    others = sorted(files.difference(*GROUPS))
    loop = Step("loop", [sys.executable, "-m", "jointplay.solver.kernels.compile_loop"])
    checks = [
        Step("format", [str(bin_folder / "ruff"), "format", "--check", "."]),
        Step("lint", [str(bin_folder / "ruff"), "check", "."]),
        Step("types", [str(bin_folder / "mypy")]),
        Step("imports", [str(bin_folder / "lint-imports")]),
    ]
    return [
        loop,
        *([] if long else checks),
        _pytest("tests", others, loop.ended, long),
        *(_pytest(f"tests/{'+'.join(group)}", group, loop.ended, long) for group in GROUPS),
    ]


def _pytest(name: str, folders: Iterable[str], after: Event, long: bool) -> Step:
    tests, times = ROOT / "tests", TIMES.with_name(f"times-{name.replace('/', '-')}.json")
    command = [sys.executable, "-m", "pytest", "-m", "long" if long else "not long"]
    command += ["--timeout", "3600"] if long else []
    command += ["-p", "tests.times", "--times", str(times)]
    command += [str(tests / folder) for folder in folders]
    if "solver" in folders:
        command += ["--ignore", str(tests / "solver/runs")]  # half of it
    return Step(name, command, times=times, after=after)


def main() -> int:
    """Run the steps and close with one line of counts."""
    long, chosen = "--long" in sys.argv, [name for name in sys.argv[1:] if name != "--long"]
    run = [step for step in steps(long=long) if not chosen or step.name in chosen]
    if not any(step.name == "loop" for step in run):
        run = [replace(step, after=None) for step in run]
    if not run:
        print("there are these steps: " + ", ".join(step.name for step in steps(long=long)))
        return 2
    begun = time.monotonic()
    with ThreadPoolExecutor(6) as pool:
        for done in as_completed([pool.submit(step.run) for step in run]):
            step = done.result()
            print(f"\n== {step.name}\n{step.output}", flush=True)
    _report(run, time.monotonic() - begun, LONG_TIMES if long else TIMES)
    return int(any(step.failed for step in run))


def _report(run: Sequence[Step], seconds: float, times: Path) -> None:
    """Print where the time went, keep what each test took, and close with one line of counts."""
    files = {}
    for step in run:
        if step.times is not None and step.times.exists():
            files |= json.loads(step.times.read_text())
    if files:
        times.write_text(json.dumps(files, indent=1))
        print(f"\n{most_expensive(files)}")
    print("\nstep                              seconds  of processor")
    for step in run:
        outcome = "FAILED" if step.failed else "ok"
        print(f"{step.name:33} {step.seconds:7.1f} {step.processor:13.1f}  {outcome}")
    counts: Counter[str] = sum((step.counts for step in run), Counter())
    print(
        f"{counts['passed']} passed, {counts['failed']} failed, {counts['skipped']} skipped "
        f"in {seconds:.0f} s, {sum(step.processor for step in run):.0f} s of processor"
    )


if __name__ == "__main__":
    raise SystemExit(main())
