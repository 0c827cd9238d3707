"""The command ``python -m benchmarks lies``: searches for wrong claims, repeatable from a seed."""

import argparse
import json
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from benchmarks.lies import named
from benchmarks.lies.covered import coverage_of
from benchmarks.lies.extremes import extremes_of
from benchmarks.lies.journal import Journal
from benchmarks.lies.measures import MEASURES
from benchmarks.lies.scenes import EVERY, LOOSE, OTHERS, SCENES
from benchmarks.lies.search import Judged, Measure, report, search

PARTS = (*MEASURES, "named")


def main() -> None:
    """Run the searches that are asked for, judge the named claims, or one job."""
    options = argparse.ArgumentParser(prog="python -m benchmarks lies", description=__doc__)
    options.add_argument("--only", choices=PARTS, nargs="+", default=list(PARTS))
    scenes = options.add_mutually_exclusive_group()
    scenes.add_argument("--scenes", choices=EVERY, nargs="+", default=list(SCENES))
    scenes.add_argument(
        "--others",
        action="store_const",
        dest="scenes",
        const=list(OTHERS),
        help="scenes whose truth far finer runs tell",
    )
    scenes.add_argument(
        "--loose",
        action="store_const",
        dest="scenes",
        const=list(LOOSE),
        help="guides, slots and cams with play, bristles and motors, at draft, standard and fine",
    )
    options.add_argument("--runs", type=int, default=100, help="of each search")
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--job", type=Path, help="a file with a job to be judged instead")
    options.add_argument(
        "--journal", type=Path, help="a folder to write verdicts to, where a search goes on later"
    )
    given = options.parse_args()
    if given.job is not None:
        job = json.loads(given.job.read_text())
        print(coverage_of(job), extremes_of(job), sep="\n")
        return
    for name in (part for part in given.only if part in MEASURES):
        print(f"\n{name}: seed {given.seed}, {given.runs} runs")
        measure = MEASURES[name]
        if given.journal is not None:
            given.journal.mkdir(parents=True, exist_ok=True)
            path = given.journal / f"{name}-{given.seed}.jsonl"
            measure = replace(measure, judge=Journal(path, measure.judge, measure.verdict))
        search(measure, given.seed, given.runs, given.scenes, partial(_tell, measure))
    if "named" in given.only:
        print(f"\n{named.report()}")


def _tell(measure: Measure[Any], judged: list[Judged]) -> None:
    """Print the tables of a search as far as it has come."""
    print(f"\nAfter {len(judged)} runs: {report(measure, judged)}", flush=True)
