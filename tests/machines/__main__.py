"""A service on several machines under a seeded schedule of faults: must it fail a job?

    python -m tests.machines --seed 7 --jobs 200

Needs root, for network namespaces, and a compiler of C, for clocks. `--fault NAME`, repeatable,
chooses faults, `--kind` a kind of jobs; `--json` prints a document. The exit code is 1 if anything
was wrong, and the folder stays then. SIGTERM and Ctrl-C end it, with all that it started.
"""

import argparse
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path

from tests.machines.campaign import Report, campaign, median_and_most
from tests.machines.faults import FAULTS

_ALONE = ("unshare", "--net", "--pid", "--fork", "--kill-child", "--mount-proc")
_INSIDE = "--inside"


def main() -> int:
    """Run a campaign in namespaces of its own; whatever it starts ends with it."""
    parser = argparse.ArgumentParser(prog="python -m tests.machines")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=200, help="how many are submitted at least")
    parser.add_argument("--fault", action="append", choices=FAULTS, help="instead of all")
    parser.add_argument("--kind", default="", help="of jobs, instead of all: simulate, sweep, ...")
    parser.add_argument("--json", action="store_true")
    parser.add_argument(_INSIDE, action="store_true", help=argparse.SUPPRESS)
    given = parser.parse_args()
    if not given.inside:
        command = [sys.executable, "-m", "tests.machines", _INSIDE, *sys.argv[1:]]
        return run_alone(command)
    folder = Path(tempfile.mkdtemp(prefix="jointplay-machines-"))
    folder.chmod(0o755)  # the database is another user, whose clock is in there
    report = campaign(
        folder,
        seed=given.seed,
        jobs=given.jobs,
        faults=given.fault or [*FAULTS],
        kind=given.kind,
        tell=_tell,
    )
    if given.json:
        print(json.dumps(asdict(report)))
    else:
        print("\n".join(lines(report)))
    if report.wrong:
        _tell(f"everything is kept in {folder}")
        return 1
    shutil.rmtree(folder)
    return 0


def run_alone(command: list[str]) -> int:
    """Run a command in namespaces of its own, which end with it. Returns its exit code."""
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    with subprocess.Popen([*_ALONE, *command]) as alone:  # which itself ignores SIGTERM
        try:
            return alone.wait()
        except KeyboardInterrupt:
            alone.kill()
            return 128 + signal.SIGTERM


def _tell(line: str) -> None:
    print(line, file=sys.stderr, flush=True)


def lines(report: Report) -> Iterator[str]:
    """Yield a table of faults that struck, with times, and what is to be said beside it."""
    row = "{:22}{:>6}{:>18}{:>13}{:>6}{:>30}{:>27}{:>24}".format
    yield row(
        "fault",
        "times",
        "lasted up to [s]",
        "blocks held",
        "lost",
        "taken over: median, most [s]",
        "started: median, most [s]",
        "back: median, most [s]",
    )
    for name in dict.fromkeys(one.fault for one in report.struck):
        those = [one for one in report.struck if one.fault == name]
        yield row(
            name,
            len(those),
            f"{max(one.lasted for one in those):.0f}",
            sum(one.held for one in those),
            sum(one.lost for one in those),
            median_and_most(those, lambda one: one.taken_over),
            median_and_most(those, lambda one: one.started),
            median_and_most(those, lambda one: one.back),
        )
    yield f"jobs: {report.jobs}, in {report.seconds:.0f} s; attempts that were lost: {report.lost}"
    yield f"answers: {report.answers}"
    yield f"files of workers that joined: {report.puts}"
    loads = [one.load for one in report.struck]
    yield f"load of the machine: {min(loads):.1f} to {max(loads):.1f} on {os.cpu_count()} cores"
    yield from (f"WRONG: {sentence}" for sentence in report.wrong)


if __name__ == "__main__":
    raise SystemExit(main())
