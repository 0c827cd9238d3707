"""Digests of every stored array: ``python -m benchmarks digests [--jointplay PATH] [--json FILE]``.

Small jobs of every kind, on every preset, in both formulations and with every method, are run by
the `jointplay` command of any installation; one SHA-256 is printed for each. Two installations
compute the same bits where their tables are equal. Measured times, the only stored numbers that a
second run does not repeat, are left out.
"""

import argparse
import hashlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import zarr

MEASURED = frozenset({"statistics/seconds"})
"""Arrays of wall-clock times."""
PRESETS = {
    "seven-bar-press": 0.05,
    "seven-bar-press-fitted": 0.05,
    "slider-crank": 0.01,
    "bouncing-journal": 0.3,
    "pendulum": 1.0,
}
"""Each preset's duration of a simulation, s."""
DRIVEN = ("seven-bar-press", "seven-bar-press-fitted", "slider-crank")
"""Presets whose drivers give studies a period."""
METHODS: dict[str, dict[str, Any]] = {
    "bogacki-shampine": {"tolerance": 1e-5},
    "tsitouras": {"tolerance": 1e-8},
    "dormand-prince-853": {"tolerance": 1e-4},
    "rodas": {"tolerance": 1e-6},
    "rk4": {"step": 2e-6},
}
VARIED = {
    "seven-bar-press": {"clearance": [3e-4, 5e-4, 1e-3]},
    "seven-bar-press-fitted": {"clearance": [3e-4, 5e-4, 1e-3]},
    "slider-crank": {"clearance": [2e-4, 4e-4, 6e-4]},
}

Documents = Iterator[tuple[str, dict[str, Any]]]


def documents() -> Documents:
    """Yield the name and the document of every job."""
    for preset, duration in PRESETS.items():
        for formulation in ("reduced", "lagrange"):
            about = {"scene": {"preset": preset}, "formulation": formulation}
            simulation = {"kind": "simulate", "duration": duration, "output_step": duration / 200}
            yield f"{preset} {formulation} simulate auto", about | simulation
            if formulation == "reduced" or preset in ("slider-crank", "seven-bar-press"):
                for method, settings in METHODS.items():
                    document = about | simulation | settings | {"method": method}
                    yield f"{preset} {formulation} simulate {method}", document
            if preset in DRIVEN:
                yield from studies(f"{preset} {formulation}", about, VARIED[preset])


def studies(name: str, about: dict[str, Any], varied: dict[str, list[float]]) -> Documents:
    """Yield studies of a mechanism that drivers move."""
    ((parameter, values),) = varied.items()
    sections = about | {"settle": 1, "record": 3}
    if name.endswith("lagrange"):
        yield f"{name} poincare", sections | {"kind": "poincare"}
        return
    diagram = {"kind": "bifurcation", "parameter": parameter, "values": values}
    onset = {"section": {"onset": "A" if "press" in name else "P"}}
    yield f"{name} bifurcation", sections | diagram | {"indicators": ["lyapunov"]}
    yield (
        f"{name} continuation",
        sections | diagram | {"continuation": "both", "chains": 1},
    )
    yield f"{name} poincare", sections | onset | {"kind": "poincare"}
    yield f"{name} ensemble", sections | {"kind": "ensemble", "members": 11, "seed": 7}
    grid = {"grid": {parameter: {"from": values[0], "to": values[-1], "count": 9}}}
    chosen = {"statistics": ["mean", "quantile_95", "impacts", "contact_share"]}
    yield f"{name} sweep", about | grid | chosen | {"kind": "sweep", "periods": 1}
    if not name.startswith("seven-bar-press-fitted"):
        study = {"methods": ["tsitouras", "rodas", "rk4"], "tolerances": [1e-4, 1e-6]}
        yield f"{name} accuracy-study", about | study | {"kind": "accuracy-study", "duration": 3e-3}


def arrays_of(results: Path) -> Iterator[tuple[str, np.ndarray]]:
    """Yield all arrays of a folder of results, or of one packed file, by path."""
    store: Any = zarr.storage.ZipStore(results, mode="r") if results.is_file() else results
    group = zarr.open_group(store, mode="r")
    members = group.members(max_depth=None, use_consolidated_for_children=False)
    for path, member in sorted(members):
        if isinstance(member, zarr.Array) and path not in MEASURED:
            yield path, np.asarray(member[...])


def digest(array: np.ndarray) -> str:
    """Return the SHA-256 of an array's type, shape and bytes."""
    found = hashlib.sha256(f"{array.dtype.str} {array.dtype.descr} {array.shape}".encode())
    found.update(np.ascontiguousarray(array).tobytes())
    return found.hexdigest()


def run(executable: str, document: dict[str, Any], folder: Path) -> dict[str, str]:
    """Run a job; return the digest of each array that it stored."""
    written = folder.with_suffix(".json")
    written.write_text(json.dumps(document))
    command = [executable, "run", str(written), "-o", str(folder), "--json"]
    ended = subprocess.run(command, capture_output=True, text=True)
    found = [p for p in (folder / "results.zarr.zip", folder / "results.zarr") if p.exists()]
    if not found:
        return {f"refused: {ended.stderr.strip()[-200:]}": ""}
    digests = {path: digest(array) for path, array in arrays_of(found[0])}
    shutil.rmtree(folder)
    return digests


def main() -> None:
    """Run all jobs, print their digests, write those of single arrays."""
    parser = argparse.ArgumentParser(prog="digests", description=__doc__)
    own = str(Path(sys.executable).with_name("jointplay"))
    parser.add_argument("--jointplay", default=own, help="the command to run")
    parser.add_argument("--json", type=Path, help="file to write the digest of each array to")
    parser.add_argument("--against", type=Path, help="such a file; print what differs from it")
    parser.add_argument("--only", default="", help="part of the names of jobs to run")
    given = parser.parse_args()
    jobs = {name: document for name, document in documents() if given.only in name}
    with tempfile.TemporaryDirectory() as top, ThreadPoolExecutor(os.cpu_count()) as pool:
        folders = [Path(top) / name.replace(" ", "-") for name in jobs]
        results = pool.map(lambda job, to: run(given.jointplay, job, to), jobs.values(), folders)
        found = {}
        for name, digests in zip(jobs, results, strict=True):
            found[name] = digests
            whole = hashlib.sha256(json.dumps(digests, sort_keys=True).encode()).hexdigest()
            shown = whole[:16] if all(digests.values()) else next(iter(digests))
            print(f"{name:55s} {len(digests):4d} arrays  {shown}", flush=True)
    if given.json:
        given.json.write_text(json.dumps(found, indent=1))
    if given.against:
        print_differences(json.loads(given.against.read_text()), found)


def print_differences(before: dict[str, dict[str, str]], now: dict[str, dict[str, str]]) -> None:
    """Print the arrays of the same jobs that differ."""
    differing = 0
    for name in sorted(before.keys() & now.keys()):
        old, new = before[name], now[name]
        paths = [path for path in sorted(old.keys() | new.keys()) if old.get(path) != new.get(path)]
        differing += bool(paths)
        if paths:
            print(f"{name}: {len(paths)} of {len(new)} arrays differ: {', '.join(paths[:8])}")
    print(f"{differing} of {len(before.keys() & now.keys())} jobs differ")
