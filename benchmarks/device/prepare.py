"""`python -m benchmarks.device.prepare FOLDER`: what a device shall compute, and a CPU has found.

The folder is all that `FOLDER/run.py` needs on a machine with a device, beside Python and NumPy.
"""

import dataclasses
import itertools
import shutil
import sys
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.device import run
from jointplay.records.impact import IMPACT
from jointplay.solver.kernels import device
from jointplay.solver.kernels.device.compiled import ptx
from jointplay.solver.kernels.device.kernel_text import kernel_text
from jointplay.solver.kernels.device.lanes import Sizes
from jointplay.solver.kernels.device.trimmed import slots_of_energies, without
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.layout import BUNDLE
from jointplay.solver.kernels.loop.runs import GROWTH, SECTIONS
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from tests.solver.readable_mechanics import preset

SIDE = 64
"""Points of a mechanism are a square of so many."""
ATTEMPTS = 5000
CAPACITY = 16, 32, 0
"""Rows, impacts and growths that a launch hands out of a lane."""
MECHANISMS: Mapping[str, Mapping[str, tuple[float, float]]] = {
    "seven-bar-press": {"clearance": (3e-4, 6e-4), "friction": (0.05, 0.15)},
    "slider-crank": {"clearance": (1e-4, 5e-4), "speed": (100.0, 300.0)},
    "four-bar": {"clearance": (2e-4, 6e-4), "friction": (0.02, 0.1)},
}


def prepare(name: str, folder: Path, side: int, *, on_host: bool = False) -> None:
    """Write starts, what a CPU finds, and code: of a device, or for this processor in its place."""
    ranges = MECHANISMS[name]
    axes = [np.linspace(*ends, side) for ends in ranges.values()]
    points = list(itertools.product(*axes))
    kernel = ready_kernel(preset(name), "reduced", "tsitouras")
    begun = time.perf_counter()
    columns, runs, ended, rows, seconds = [], [], [], [], 0.0
    for first in range(0, len(points), BUNDLE):
        chosen = points[first : first + BUNDLE]
        scenes = [preset(name, **dict(zip(ranges, map(float, p), strict=True))) for p in chosen]
        problems = [LaneProblem(s, 1e6, 1e-6, 1e6, 1, 2**40, 0.0) for s in scenes]
        bundle = Bundle(kernel, problems, watch=False)
        columns.append(work_of(bundle))
        runs.append(bundle.runs.copy())
        start = time.process_time()
        handed = advanced(bundle)
        seconds += time.process_time() - start
        ended.append((work_of(bundle), bundle.runs.copy()))
        rows += handed
    work, records = np.concatenate(columns, axis=1), np.concatenate(runs)
    last, final = (np.concatenate([e[k] for e in ended], axis=-1) for k in range(2))
    attempts = ATTEMPTS * len(points)
    print(
        f"{name}: {len(points)} points in {time.perf_counter() - begun:.0f} s, of which"
        f" {seconds:.1f} s of {attempts} attempts: {seconds / attempts * 1e9:.0f} ns each;"
        f" onsets {final['onsets'].sum()}, attended {final['attended'].sum() / attempts:.1%}",
        flush=True,
    )
    sizes = Sizes(0, kernel.layout.size, *CAPACITY)
    scratch = [kernel.layout["potential"], kernel.layout["stored"]]
    left_out = {"whole": scratch, "lean": [*scratch, *slots_of_energies(kernel)]}
    every = np.arange(len(work))
    compared = {which: np.setdiff1d(every, some) for which, some in left_out.items()}
    varied = np.flatnonzero((work != work[:, :1]).any(axis=1))
    np.savez_compressed(
        folder / f"{name}.npz",
        allow_pickle=False,
        first=work[:, 0],
        varied=varied,
        numbers=work[varied],
        runs=records.view(np.uint8),
        kinds=np.array([repr(kind.descr) for kind in (records.dtype, IMPACT, GROWTH)]),
        offsets=np.array([records.dtype.itemsize]),
        sizes=sizes,
        width=kernel.row.width,
        attempts=ATTEMPTS,
        time=kernel.layout["time"],
        cpu=seconds,
        cpu_revolutions=revolutions(last, final, kernel),
        sections=[len(one) for one in rows],
        **{f"slots_{which}": slots for which, slots in compared.items()},
        **{
            f"digests_{which}": run.digests(last[slots], final, rows)
            for which, slots in compared.items()
        },
    )
    for variant, text in texts(kernel, sizes, work, on_host).items():
        (folder / f"{name}{variant}.ptx").write_text(text if on_host else ptx(text))


def work_of(bundle: Bundle) -> Any:
    return np.concatenate([group.work for group in bundle.groups], axis=1).copy()


def revolutions(work: Any, runs: Any, kernel: Kernel) -> float:
    now = runs["periods"] * runs["period"] + work[kernel.layout["time"]]
    return float((now / runs["unit"]).sum())


def advanced(bundle: Bundle) -> list[Any]:
    """Return the sections of each lane."""
    handed: list[list[Any]] = [[] for _ in range(BUNDLE)]
    while bundle.attempts < ATTEMPTS:
        bundle.advance(ATTEMPTS - bundle.attempts)
        for i in range(BUNDLE):
            handed[i].append(bundle.rows(SECTIONS, i).copy())
    return [np.concatenate(one) for one in handed]


def texts(kernel: Kernel, sizes: Sizes, work: Any, on_host: bool) -> dict[str, str]:
    """Return the kernel's text in several variants."""
    sources = kernel.module.sources
    lean = list(without(slots_of_energies(kernel), sources))
    shared = {
        slot: float(work[slot, 0])
        for slot in kernel.fixed.slots
        if (work[slot] == work[slot, 0]).all()
    }
    constant = list(with_constants(shared, lean))

    def text(chosen: Sequence[Any]) -> str:
        return kernel_text(chosen, kernel.slots, sizes, on_host=on_host)

    given = "ptr %W" if on_host else "ptr %W.given"
    called = text(constant).replace(
        f'define void @"slopes"({given}, i64 %index) alwaysinline',
        f'define void @"slopes"({given}, i64 %index) noinline',
    )
    return {"": text(sources), "_constant": text(constant), "_called": called}


def with_constants(numbers: Mapping[int, float], sources: Iterable[Source]) -> Iterator[Source]:
    """Yield tapes that have the numbers of some slots, into which nothing is stored, written in."""
    for one in sources:
        known: dict[str, str] = {}
        lines = []
        for line in one.lines:
            words = line.split()
            slot = _loaded(words)
            if slot in numbers:
                known[words[0]] = repr(numbers[slot])
            else:
                lines.append(" ".join(words[:1] + [known.get(word, word) for word in words[1:]]))
        yield dataclasses.replace(one, lines=tuple(lines))


def _loaded(words: list[str]) -> int:
    plain = len(words) == 4 and words[2] in ("load", "spread") and words[3].isdigit()
    return int(words[3]) if plain else -1


def main(arguments: Sequence[str]) -> None:
    folder, side = Path(arguments[0]), int(arguments[1]) if len(arguments) > 1 else SIDE
    package = folder / "jointplay" / "solver" / "kernels" / "device"
    package.mkdir(parents=True, exist_ok=True)
    for place in (package, *list(package.parents)[:3]):
        (place / "__init__.py").write_text("")
    for name in ("driver.py", "lanes.py"):
        shutil.copy(Path(device.__file__).parent / name, package)
    shutil.copy(run.__file__, folder)
    for name in MECHANISMS:
        prepare(name, folder, side)


if __name__ == "__main__":
    main(sys.argv[1:])
