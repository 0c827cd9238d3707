"""Cost of the results store: creating, filling, sealing, reading."""

import argparse
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path
from time import perf_counter

import numpy as np

from jointplay.records.channel import Channel
from jointplay.records.impact import IMPACT
from jointplay.records.peak import Peak
from jointplay.records.run_rows import RunRows
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.object_stores.folder import Folder
from jointplay.storage.packed import Packed
from jointplay.storage.results.layout import ResultLayout
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.results.writer import ResultWriter

CHANNELS = 95
REPEATS = 7


def layout(samples: int, sections: int) -> ResultLayout:
    channels = tuple(
        Channel(f"body{index // 9}.coordinate{index % 9}", "m", "position of a centre of mass")
        for index in range(CHANNELS)
    )
    return ResultLayout(channels, samples, sections, ("A", "B"), {"job": {"kind": "simulate"}})


def rows(count: int) -> tuple[np.ndarray, np.ndarray]:
    time = np.linspace(0.0, 2.0, count)
    noise = np.random.default_rng(0).normal(scale=1e-9, size=(count, CHANNELS))
    return time, np.sin(time[:, None] * np.arange(1, CHANNELS + 1)) + noise


def show(what: str, seconds: float) -> None:
    print(f"{what:<58}{1e3 * seconds:10.2f} ms")


def timed(action: Callable[[], object]) -> float:
    begin = perf_counter()
    action()
    return perf_counter() - begin


def default_history(folder: Path) -> None:
    """Store 2001 samples, 2 sections, 100 impacts: one revolution of a press."""
    time, samples = rows(2001)
    peaks = {channel.name: Peak(0.0, 0.0, 1.0, 1.0) for channel in layout(1, 0).channels}
    costs: dict[str, list[float]] = {}
    for repeat in range(REPEATS):
        path = folder / f"small{repeat}"
        begin = perf_counter()
        writer = ResultWriter.create(path, layout(2001, 2))
        created = perf_counter()
        writer.append(
            RunRows(
                sample_time=time,
                samples=samples,
                section_time=time[:2],
                sections=samples[:2],
                impacts=np.zeros(100, IMPACT),
            )
        )
        appended = perf_counter()
        target = StoredObject(Folder(str(folder)), f"small{repeat}.zip")
        writer.seal(target, peaks=peaks, summary={})
        sealed = perf_counter()
        reader = ResultReader(Packed(target))
        opened = perf_counter()
        reader.history()
        read = perf_counter()
        for name, cost in (
            ("create (96 channels: documents of the groups)", created - begin),
            ("append 2001 samples", appended - created),
            ("seal into one file, fsynced", sealed - appended),
            ("open for reading", opened - sealed),
            ("read all channels", read - opened),
        ):
            costs.setdefault(name, []).append(cost)
    for name, values in costs.items():
        show(f"2001 samples: {name}", min(values))
    show("2001 samples: read one channel", timed(lambda: reader.history(["body0.coordinate3"])))
    show("2001 samples: verify against the manifest", timed(reader.verify))
    size = reader.files.entry("zarr.json").size
    print(f"2001 samples: size of the root's zarr.json{size / 1e3:33.1f} kB")


def long_history(folder: Path) -> None:
    """Append a million samples in slices of 5000."""
    samples, piece = 1_000_000, 5000
    time, values = rows(piece)
    writer = ResultWriter.create(folder / "long", layout(samples, 0))
    target = StoredObject(Folder(str(folder)), "long.zip")

    def fill() -> None:
        for first in range(0, samples, piece):
            writer.append(RunRows(first_sample=first, sample_time=time + first, samples=values))

    show("1e6 samples: append, 760 MB", timed(fill))
    show("1e6 samples: checkpoint, 17 000 rows waiting", timed(writer.checkpoint))
    show("1e6 samples: seal", timed(lambda: writer.seal(target, peaks={}, summary={})))
    reader = ResultReader(Packed(target))
    name = ["body0.coordinate3"]
    show("1e6 samples: slice of 1000", timed(lambda: reader.history(name, 500_000, 501_000)))
    show("1e6 samples: one whole channel", timed(lambda: reader.history(name)))


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m benchmarks results_store", description=__doc__)
    parser.add_argument(
        "--folder", help="where stores are written: its disk decides what fsync costs"
    )
    parent = parser.parse_args().folder
    folder = Path(tempfile.mkdtemp(prefix="results_store_", dir=parent))
    try:
        default_history(folder)
        long_history(folder)
    finally:
        shutil.rmtree(folder)


if __name__ == "__main__":
    main()
