"""Seconds and memory of compiling kernels, against the length of a scene's equations.

    python -m benchmarks compilation [--most 20] [--tangents] [--only four-bars]

Chains of bodies, bodies that each have play, rows of four-bars (N of them have 2 N + 1 bodies)
and the press, in both formulations; seconds are those of the processor.  Every scene is compiled in
a process of its own, into an empty cache that has the driving loop only, and loaded from there by
another.  Emitted lines are what the compiler is given.
"""

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from typing import Any

from benchmarks.four_bars import four_bars
from benchmarks.hostile_bodies import chain, free
from jointplay.records.failure import LimitExceeded
from jointplay.solver.kernels.emit.tangents import compile_tangents
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.loop_code import FOR_RUNS, begin, wait_for
from jointplay.solver.kernels.trace.equations import trace
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.presets import document


def press(_count: int) -> dict[str, Any]:
    """Return the preset, of six bodies."""
    return document("seven-bar-press")


SCENES = {"chain": chain, "free": free, "four-bars": four_bars, "press": press}
COUNTS = {
    "chain": (4, 8, 12, 14, 16, 20, 32, 64),
    "free": (4, 8, 12, 14, 16, 20, 32, 64),
    "four-bars": (1, 5, 10, 20, 40),
    "press": (6,),
}
FORMULATIONS = ("reduced", "lagrange")
PATIENCE = 900.0  # s a scene


def cases(most: int, only: str | None) -> Iterator[tuple[str, int, str]]:
    """Yield what is compiled: scene, bodies or four-bars, formulation."""
    for name in [only] if only else SCENES:
        for count in COUNTS[name]:
            for formulation in FORMULATIONS:
                if count <= most:
                    yield name, count, formulation


def compiled(name: str, count: int, formulation: str, with_tangents: bool) -> dict[str, object]:
    """Compile one scene in this process and return what it took."""
    scene = Scene.model_validate(SCENES[name](count))
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    begun = processor()
    try:
        trace(scene, spanning_tree(scene), formulation)
        traced = processor() - begun
        kernel = ready_kernel(scene, formulation)
        tangents_begun = processor()
        modules = [kernel.module]
        if with_tangents:
            modules.append(compile_tangents(kernel).module)
    except LimitExceeded as refused:
        return {"refused": str(refused)}
    ended = processor()
    return {
        "tracing": traced,
        "kernel": tangents_begun - begun - traced,
        "tangents": ended - tangents_begun,
        "lines": sum(len(one.lines) for module in modules for one in module.sources),
        "before": before / 1024,
        "peak": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
    }


def processor() -> float:
    """Return the processor's seconds of this process and of those that it waited for."""
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks compilation")
    parser.add_argument("--most", type=int, default=20, help="most bodies, or four-bars")
    parser.add_argument("--only", choices=list(SCENES), help="one kind of scene")
    parser.add_argument("--tangents", action="store_true", help="those of exponents, too")
    parser.add_argument("--one", nargs=3, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.one:
        name, count, formulation = arguments.one
        if compiling := begin(FOR_RUNS):
            wait_for(compiling)
        print(json.dumps(compiled(name, int(count), formulation, arguments.tangents)))
        return
    print(
        "scene      count  formulation   lines    tracing s  kernel s  tangents s  peak MB  cached"
    )
    for name, count, formulation in cases(arguments.most, arguments.only):
        print(f"{name:<10}{count:6d}  {formulation:<11}", end="", flush=True)
        print(_in_a_process(name, count, formulation, arguments.tangents), flush=True)


def _in_a_process(name: str, count: int, formulation: str, with_tangents: bool) -> str:
    command = [sys.executable, "-m", "benchmarks", "compilation"]
    command += ["--one", name, str(count), formulation] + ["--tangents"] * with_tangents
    with tempfile.TemporaryDirectory() as folder:
        environment = os.environ | {"JOINTPLAY_CACHE": folder}
        try:
            done, again = (
                subprocess.run(
                    command, capture_output=True, env=environment, timeout=PATIENCE, check=True
                )
                for _ in range(2)
            )
        except subprocess.TimeoutExpired:
            return f"  more than {PATIENCE:g} s"
    found = json.loads(done.stdout.splitlines()[-1])
    if "refused" in found:
        return f"  {found['refused']}"
    cached = json.loads(again.stdout.splitlines()[-1])["kernel"]
    return (
        f"{found['lines']:8d}{found['tracing']:13.2f}{found['kernel']:10.1f}"
        f"{found['tangents']:12.1f}{found['peak']:9.0f}{cached:10.2f}"
    )


if __name__ == "__main__":
    main()
