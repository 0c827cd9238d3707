"""`python run.py`: compare a device with what `prepare` has found on a CPU, and time it."""

import ast
import hashlib
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from jointplay.solver.kernels.device.driver import LOCAL, REGISTERS, Code, Device, DeviceError
from jointplay.solver.kernels.device.lanes import BLOCK, ENTRY, DeviceLanes, Sizes

COUNTED = ("filled", "impacts", "growths", "kept")
"""Fields of a run that tell what a launch handed out."""
WARM, TIMED = 3000, 4000
"""Attempts before the clock runs, and while it does."""
EACH = 500
"""Attempts of a launch while bits are compared."""
LANES = (33_792, 135_168)
WHOLE, LEAN = "whole", "lean"


def digests(work: Any, runs: Any, rows: Sequence[Any]) -> Any:
    """Return a number for each lane of what it has come to: quantities, record, and sections."""
    fields = [name for name in runs.dtype.names if name not in COUNTED]
    columns = np.ascontiguousarray(work.T)
    found = np.empty(len(columns), np.int64)
    for i in range(len(columns)):
        told = hashlib.sha256(columns[i].tobytes())
        for name in fields:
            told.update(np.ascontiguousarray(runs[name][i]).tobytes())
        told.update(np.ascontiguousarray(rows[i]).tobytes())
        found[i] = int.from_bytes(told.digest()[:8], "little", signed=True)
    return found


class Given:
    """A mechanism, as `prepare` has written it."""

    def __init__(self, folder: Path, name: str) -> None:
        with np.load(folder / f"{name}.npz") as saved:
            self.saved = dict(saved)
        run, impact, growth = (
            np.dtype(ast.literal_eval(str(kind))) for kind in self.saved["kinds"]
        )
        self.kinds = run, impact, growth
        self.points = self.saved["numbers"].shape[1]
        self.columns = np.repeat(self.saved["first"][:, None], self.points, axis=1)
        self.columns[self.saved["varied"]] = self.saved["numbers"]
        self.runs = self.saved["runs"].view(run)
        self.sizes, self.width = Sizes(*map(int, self.saved["sizes"])), int(self.saved["width"])
        self.attempts = int(self.saved["attempts"])

    def lanes(self, device: Device, code: Code, count: int, block: int = BLOCK) -> DeviceLanes:
        """Return so many lanes at the start of points, one after the other and again."""
        sizes = self.sizes._replace(lanes=count)
        lanes = DeviceLanes(device, code, sizes, self.width, self.kinds, block)
        points = np.arange(count) % self.points
        lanes.columns.write(self.columns[:, points])
        lanes.runs.write(self.runs[points])
        return lanes

    def revolutions(self, columns: Any, runs: Any) -> float:
        """Return how many revolutions of the fastest driver lie behind all lanes."""
        now = runs["periods"] * runs["period"] + columns[int(self.saved["time"])]
        return float((now / runs["unit"]).sum())


def equal(given: Given, device: Device, code: Code, which: str) -> int:
    """Return how many points have the CPU's bits after so many attempts."""
    lanes = given.lanes(device, code, given.points)
    left = np.full(given.points, given.attempts)
    rows: list[list[Any]] = [[] for _ in range(given.points)]
    while left.any():
        lanes.launch(int(min(left[left > 0].min(), EACH)))
        device.finish()
        left -= lanes.made.read()
        runs = lanes.runs.read()
        filled = runs["filled"][:, 1]
        handed = lanes.rows(int(filled.max()))
        for i in np.flatnonzero(filled):
            rows[i].append(handed[i, 1, : filled[i]])
        if left.min() != left.max():
            raise SystemExit(f"lanes made {left.min()} to {left.max()} attempts: a buffer is full")
    columns = lanes.columns.read()[given.saved[f"slots_{which}"]]
    lanes.release()
    joined = [np.concatenate(one) if one else np.zeros((0, given.width)) for one in rows]
    found = digests(columns, runs, joined)
    return int((found == given.saved[f"digests_{which}"]).sum())


def rate(
    given: Given, device: Device, code: Code, count: int, block: int
) -> tuple[float, float, float, float]:
    """Return revolutions and attempts a second, the part attended, and the time, s."""
    lanes = given.lanes(device, code, count, block)
    lanes.launch(WARM)
    device.finish()
    before, runs = given.revolutions(lanes.columns.read(), lanes.runs.read()), lanes.runs.read()
    begun = time.perf_counter()
    lanes.launch(TIMED)
    device.finish()
    seconds = time.perf_counter() - begun
    made, after = lanes.made.read().sum(), lanes.runs.read()
    revolved = given.revolutions(lanes.columns.read(), after) - before
    attended = (after["attended"].sum() - runs["attended"].sum()) / made
    lanes.release()
    return revolved / seconds, made / seconds, attended, seconds


def main(arguments: Sequence[str]) -> None:
    """Say bits and rates; VARIANT[:REGISTERS[:THREADS]] ... of code, by default one of each."""
    folder = Path(__file__).parent
    device = Device()
    print(
        f"{device.name}: {device.processors} multiprocessors,"
        f" single precision {device.ratio} times as fast as double",
        flush=True,
    )
    for name in sorted(one.stem for one in folder.glob("*.npz")):
        given = Given(folder, name)
        cpu = given.saved["cpu_revolutions"] / given.saved["cpu"]
        print(f"{name}: {given.points} points; one core of the other machine {cpu:.0f} rev/s")
        for variant in arguments or ("", "_constant"):
            try:
                measure(given, device, folder / name, variant, LANES)
            except DeviceError as error:
                print(f"  {error}", flush=True)


def measure(given: Given, device: Device, path: Path, variant: str, counts: Sequence[int]) -> None:
    """Say how many points have the CPU's bits, and how fast so many lanes are."""
    which, registers, block = [*variant.split(":"), "", ""][:3]
    text = path.with_name(f"{path.name}{which}.ptx").read_text()
    if registers:
        before, entry, behind = text.partition(".entry advance(")
        behind = behind.replace(")\n{", f")\n.maxnreg {registers}\n{{", 1)
        text = before + entry + behind
    begun = time.perf_counter()
    code = Code(device, text)
    print(
        f" {variant or 'whole'}: loaded in {time.perf_counter() - begun:.1f} s,"
        f" {code.attribute(ENTRY, REGISTERS)} registers, {code.attribute(ENTRY, LOCAL)} bytes",
        flush=True,
    )
    if not registers:
        same = equal(given, device, code, LEAN if which else WHOLE)
        print(f"  {same} of {given.points} points have the CPU's bits", flush=True)
    for count in counts if variant == "_constant" else counts[-1:]:
        revolutions, attempts, attended, seconds = rate(
            given, device, code, count, int(block or BLOCK)
        )
        print(
            f"  {count} lanes: {revolutions:.0f} rev/s, {attempts / 1e9:.3f}e9 attempts/s,"
            f" {attended:.2%} attended, {seconds:.2f} s",
            flush=True,
        )


if __name__ == "__main__":
    main(sys.argv[1:])
