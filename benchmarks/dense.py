"""Cost of keeping steps, or extremes between samples: time and bytes, and how long windows take.

The press of `benchmarks.press`, ten revolutions at the tolerance 1e-6. Runs with and without steps
alternate; windows over HTTP are asked of a service in a process of its own, one channel and 2000
spans, kernels warm: elapsed time. Everything else is time of the processor.
"""

import statistics
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import httpx
import numpy as np

from benchmarks.press import CASE
from benchmarks.results_http import service
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.runs.simulate import Simulation
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import BlockEnd, BlockState
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.object_stores.folder import Folder
from jointplay.storage.packed import Packed
from jointplay.storage.results.intervals import GROUP as INTERVALS
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.results.steps import GROUP
from jointplay.storage.settings import Settings
from jointplay.worker.execute import Answer, execute
from jointplay.worker.windows.evaluate import answer
from jointplay.worker.windows.trajectory import Trajectory

PARAMETERS = CASE | {"clearance": 5e-4}
REVOLUTIONS = 10
REPEATS, ASKED = 9, 15
FORCE = "A.normal_force"


def document(**more: Any) -> dict[str, Any]:
    scene = {"preset": "seven-bar-press", "parameters": PARAMETERS}
    fields = {"kind": "simulate", "scene": scene, "certificate": False, "tolerance": 1e-6}
    short = admit(fields | {"duration": 1.0})
    assert isinstance(short, Admission)
    return fields | {"duration": REVOLUTIONS * (short.period or 0.0)} | more


def seconds(work: Callable[[], Any], clock: Callable[[], float]) -> float:
    begun = clock()
    work()
    return clock() - begun


def solved(admission: Admission) -> int:
    simulation = Simulation(admission)
    for _ in simulation.slices():
        pass
    return int(simulation.summary().statistics["steps"])


def saved(admission: Admission) -> dict[str, int]:
    """Return bytes by group of the store; "" : what is in none."""
    with tempfile.TemporaryDirectory() as folder:
        target = StoredObject(Folder(folder), "run.zip")
        execute(admission, Path(folder) / "running", target, report=lambda _: Answer.go_on)
        found: dict[str, int] = {}
        for key, entry in Packed(target).entries.items():
            group = key.partition("/")[0] if key.startswith((GROUP, INTERVALS)) else ""
            found[group] = found.get(group, 0) + entry.size
        return found


def of_runs() -> None:
    """Print seconds of processor: load from elsewhere does not count."""
    limits = {"kept": {}, "dropped, extremes between samples": {"steps_limit": 0}}
    works: dict[str, tuple[Callable[[Admission], Any], bool]] = {
        "solver": (solved, False),
        "stored": (saved, False),
        "certificate": (saved, True),
    }
    found: dict[tuple[str, str], list[float]] = {}
    for k in range(REPEATS + 1):
        for name, limit in limits.items():
            for what, (work, certificate) in works.items():
                admission = admit(document(certificate=certificate, **limit))
                assert isinstance(admission, Admission)
                begun = time.process_time()
                work(admission)
                if k:  # the first loads kernels
                    found.setdefault((name, what), []).append(time.process_time() - begun)
    print(f"{REVOLUTIONS} revolutions, seconds of processor, medians of {REPEATS}:")
    for (name, what), times in found.items():
        print(f"  steps {name}; {what}: {1e3 * statistics.median(times):.0f} ms")
    for name, limit in limits.items():
        admission = admit(document(**limit))
        assert isinstance(admission, Admission)
        sizes = {group or "rest": size // REVOLUTIONS for group, size in saved(admission).items()}
        print(f"  steps {name}: {sizes} bytes a revolution")


def stored(settings: Settings, job: str) -> None:
    target = settings.sealed_run(job, 1)
    entries = Packed(target).entries
    steps = sum(entry.size for key, entry in entries.items() if key.startswith(f"{GROUP}/"))
    reader = ResultReader(Packed(target))
    assert reader.steps is not None
    raw = 8 * reader.steps.count * len(reader.steps.columns)
    print(
        f"steps: {raw / REVOLUTIONS / 1e3:.0f} kB a revolution, {steps / REVOLUTIONS / 1e3:.0f} kB"
        f" compressed ({reader.steps.count / REVOLUTIONS:.0f} steps of"
        f" {len(reader.steps.columns)} columns); the whole store {target.size() / 1e3:.0f} kB"
    )


def of_windows(settings: Settings, url: str, job: str) -> None:
    reader = ResultReader(Packed(settings.sealed_run(job, 1)))
    trajectory = Trajectory(reader, answer)
    period = float(reader.attributes["period"])
    windows = {"1 ms": 1e-3, "a revolution": period, "the whole run": REVOLUTIONS * period}
    every = [channel.name for channel in reader.channels]
    with httpx.Client(base_url=url, timeout=120) as http:
        for name, width in windows.items():
            start = 0.01 if width < period else 0.0
            edges = np.linspace(start, start + width, 2001)
            query = {"channels": FORCE, "start": start, "stop": start + width}
            ask = partial(http.get, f"/v1/jobs/{job}/history")
            works: dict[str, Callable[[], Any]] = {
                "one channel": partial(trajectory.extremes, [FORCE], edges),
                f"all {len(every)}": partial(trajectory.extremes, every, edges),
                "HTTP, steps": partial(ask, params=query | {"points": 2000}),
                "HTTP, samples": partial(ask, params=query),
            }
            shown = []
            for what, work in works.items():
                work()
                clock = time.perf_counter if what.startswith("HTTP") else time.process_time
                taken = statistics.median(seconds(work, clock) for _ in range(ASKED))
                shown.append(f"{what} {1e3 * taken:.1f} ms")
            print(f"  {name}: {', '.join(shown)}")


def main() -> None:
    of_runs()
    with tempfile.TemporaryDirectory() as folder:
        settings = Settings(data=Path(folder))
        with service(Path(folder)) as url:
            with httpx.Client(base_url=url) as http:
                job = str(http.post("/v1/jobs", json=document()).raise_for_status().json()["id"])
            catalogue = Catalogue(settings.catalogue_url)
            claim = catalogue.claim_block(catalogue.blocks(job)[0].id, "benchmark", 600.0)
            assert claim is not None
            admission = admit(claim.job.spec)
            assert isinstance(admission, Admission)
            running = settings.running_run(job, 1).folder
            sealed = settings.sealed_run(job, 1)
            execute(admission, running, sealed, report=lambda _: Answer.go_on)
            catalogue.finish(claim.block.id, claim.block.attempt, BlockEnd(BlockState.done))
            catalogue.close()
            stored(settings, job)
            print("windows of 2000 spans, medians:")
            of_windows(settings, url, job)


if __name__ == "__main__":
    main()
