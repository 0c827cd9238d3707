"""Charts of an impact oscillator beside closed forms of where its motion changes.

    python -m benchmarks.chart_curves [SIDE [ROWS [FOLDER]]]

A chart of SIDE x SIDE points (default 100) from the scene's start is refined; it is killed five
times at random and resumed. Rows of ROWS speeds (default 20) and SIDE amplitudes follow their
neighbours upwards and downwards. Distances of each curve to the nearest boundary of a map in the
row of its speed, across the curve, in pixels. With a FOLDER results and a picture stay there.
"""

import argparse
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks import rigid_stop
from benchmarks.continuation import scene
from jointplay.local import load, run
from jointplay.records.arrays import Flags, Floats

SPEEDS, AMPLITUDES = (10.0, 40.0), (1e-3, 2e-2)  # rad/s, m
STOP = 1e11  # N/m^1.5
DEPTH = 3
KILLS = 5
SHARED: dict[str, Any] = {
    "kind": "chart",
    "scene": scene(STOP),
    "record": 12,
    "tolerance": 1e-6,
    "indicators": ["recurrence"],
    "statistics": ["impacts"],
}
CURVES = {
    "grazing": rigid_stop.grazing,
    "fold": rigid_stop.fold,
    "doubling": rigid_stop.doubling,
}


def axis(parameter: str, ends: tuple[float, float], count: int) -> dict[str, Any]:
    """Return an axis of a chart."""
    return {"parameter": parameter, "values": {"from": ends[0], "to": ends[1], "count": count}}


def refined(side: int) -> dict[str, Any]:
    """Return the chart from the scene's start."""
    axes = {"along": axis("speed", SPEEDS, side), "by": axis("amplitude", AMPLITUDES, side)}
    return SHARED | axes | {"settle": 200, "refine": DEPTH}


def rows(side: int, speeds: Floats, direction: str) -> dict[str, Any]:
    """Return a chart whose points follow their neighbours in amplitude."""
    by = {"parameter": "speed", "values": speeds.tolist()}
    along = {"along": axis("amplitude", AMPLITUDES, side), "by": by}
    return SHARED | along | {"settle": 40, "continuation": direction}


def used(group: int) -> float:
    """Return the processor seconds of the processes of a group."""
    ticks = 0
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[2]) == group:
            ticks += sum(map(int, fields[11:13]))
    return ticks / os.sysconf("SC_CLK_TCK")


def computed(job: dict[str, Any], folder: Path, kills: int = 0) -> tuple[float, int]:
    """Compute a chart, killed at most as often; return its processor seconds, and the kills."""
    document = folder.with_suffix(".json")
    document.write_text(json.dumps(job))
    command = [sys.executable, "-m", "jointplay", "run"]
    first, chance = [str(document), "-o", str(folder)], random.Random(7)
    spent, killed = 0.0, 0
    while True:
        resumed = (folder / "running").exists()
        given = ["--resume", str(folder)] if resumed else first
        process = subprocess.Popen(
            [*command, *given],
            start_new_session=True,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        last, until = 0.0, chance.uniform(5.0, kills + 25.0) if killed < kills else np.inf
        while process.poll() is None:
            last = max(last, used(process.pid))
            if last > until:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
                killed += 1
            time.sleep(0.2)
        spent += last
        if process.returncode > 0:
            raise SystemExit(f"{folder} ended with {process.returncode}")
        if process.returncode == 0:
            return spent, killed


def classes(data: Any) -> tuple[Flags, Flags]:
    """Return over (speed, amplitude) where a chart strikes, and where once a period."""
    ordered = data.transpose("speed", "amplitude")
    impacts, period = ordered["stop.impacts"].values, ordered["period"].values
    once = (period == 1.0) & (np.abs(impacts - SHARED["record"]) <= 1.0)
    return impacts > 0.0, once


def same_alone(data: Any, side: int) -> bool:
    """Return whether a rectangle of a chart has its bits if it is computed alone, by one process.

    It begins at points of the coarse grid. Cells that its far edges cut are left out.
    """
    cells, size = 4 * 2**DEPTH, 5 * 2**DEPTH
    x, y = (int(share * side) >> DEPTH << DEPTH for share in (0.28, 0.2))  # where it doubles
    part = data.isel(speed=slice(x, x + size), amplitude=slice(y, y + size))
    job = refined(side)
    for name in ("along", "by"):
        job[name] = {"parameter": job[name]["parameter"]}
        job[name]["values"] = part[job[name]["parameter"]].values.tolist()
    alone = run(job, processes=1).dataset
    inside = {"speed": slice(0, cells), "amplitude": slice(0, cells)}
    return bool(alone.isel(inside).identical(part.isel(inside)))


def distances(curve: str, shown: Flags, speeds: Floats, amplitudes: Floats) -> Floats:
    """Return how far the nearest boundary is from a curve, in pixels; NaN where there is none.

    `shown` : (speed, amplitude). Across the curve, from the distance in its row and its slope.
    """
    pixel = amplitudes[1] - amplitudes[0]
    slope_over = (SPEEDS[1] - SPEEDS[0]) / (len(amplitudes) - 1)  # a pixel of a square chart
    of = CURVES[curve]
    here = of(speeds)
    steep = (of(speeds + 1e-4).amplitude - of(speeds - 1e-4).amplitude) / 2e-4
    slope = steep * slope_over / pixel
    column = (here.amplitude - amplitudes[0]) / pixel
    inside = here.admissible & (column > 1.0) & (column < len(amplitudes) - 2.0)
    away = np.full(len(speeds), np.nan)
    for row in np.flatnonzero(inside):
        edges = np.flatnonzero(np.diff(shown[row])) + 0.5
        nearest = np.abs(edges - column[row]).min(initial=np.inf)
        away[row] = nearest / np.hypot(1.0, slope[row])
    return away


def told(name: str, away: Floats, speeds: Floats) -> None:
    """Print how far a curve lies from a map's boundaries, and where that is far."""
    known = np.isfinite(away) | np.isinf(away)
    if not known.any():
        return
    shares = [float(np.mean(away[known] <= limit)) for limit in (1.0, 2.0)]
    print(
        f"{name:38} {known.sum():5d} speeds, within 1 pixel {shares[0]:6.1%}, 2 {shares[1]:6.1%},"
        f" median {np.median(away[known]):.2f}"
    )
    far = speeds[known & ~(away <= 2.0)]
    if len(far):
        parts = np.split(far, np.flatnonzero(np.diff(far) > 1.0) + 1)
        print("    farther: " + ", ".join(f"{p[0]:.1f}-{p[-1]:.1f} ({len(p)})" for p in parts))


def main() -> None:
    """Compute the charts and print their distances from the curves."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.chart_curves", description=__doc__)
    parser.add_argument("side", type=int, nargs="?", default=100, help="points along each axis")
    parser.add_argument("count", type=int, nargs="?", default=20, help="rows")
    parser.add_argument("folder", type=Path, nargs="?", help="where the results are kept")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = given.folder or Path(scratch)
        folder.mkdir(exist_ok=True)
        measured(given.side, given.count, folder)


def measured(side: int, count: int, folder: Path) -> None:
    """Compute and print."""
    amplitudes, every = (np.linspace(*ends, side) for ends in (AMPLITUDES, SPEEDS))
    seconds, killed = computed(refined(side), folder / "refined", KILLS)
    data = load(folder / "refined").dataset
    _, once = classes(data)
    share = float((data["inherited"].values == 0.0).mean())
    print(f"{side} x {side}, refined, killed {killed} times: {seconds / 60.0:.1f} core-minutes,")
    print(f"{share:.1%} of the points computed, {data['steps'].values.sum():.3g} steps")
    print(f"a rectangle of it alone has the same bits: {same_alone(data, side)}")
    told("doubling, from the scene's start", distances("doubling", once, every, amplitudes), every)
    speeds = every[np.linspace(0, side - 1, count).round().astype(int)]
    for direction, curve in (("forward", "grazing"), ("backward", "fold")):
        output = folder / direction
        seconds, _ = computed(rows(side, speeds, direction), output)
        strikes, once = classes(load(output).dataset)
        print(f"{count} rows {direction}: {seconds / 60.0:.1f} core-minutes")
        told(f"{curve}, {direction}", distances(curve, strikes, speeds, amplitudes), speeds)
        away = distances("doubling", once, speeds, amplitudes)
        told(f"doubling, {direction}", away, speeds)


if __name__ == "__main__":
    main()
