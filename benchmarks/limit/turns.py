"""Turns of several programs at the same ways, and processes of products."""

import json
import os
import subprocess
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path

from benchmarks.limit.product import WAYS, Case, Measured, Way

PRODUCT = Path(__file__).with_name("product.py")
Samples = dict[str, dict[str, list[Measured]]]
"""Measurements by program and way; a way that a program lacks is not there."""


class Product:
    """A process of an installed product that measures the ways of a case."""

    def __init__(self, case: Case, lanes: int, installed: Path | None = None) -> None:
        """`installed` : folder with another version than this environment's."""
        environment = os.environ | {"JOINTPLAY_LANES": str(lanes)}
        environment["PYTHONPATH"] = "" if installed is None else str(installed)
        self._process = subprocess.Popen(
            [sys.executable, "-P", str(PRODUCT), json.dumps(asdict(case))],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env=environment,
        )
        hello = self._answer()
        self.version, self.lanes = str(hello["version"]), int(str(hello["lanes"]))
        self.lacking: dict[str, str] = {}
        """Why ways cannot be measured, by name."""
        for name in WAYS:
            found = self.ask(name)
            if "lacking" in found:
                self.lacking[name] = str(found["lacking"])

    def ask(self, way: str) -> dict[str, object]:
        """Have a way measured; return the answer."""
        assert self._process.stdin is not None
        self._process.stdin.write(f"{way}\n")
        self._process.stdin.flush()
        return self._answer()

    def ways(self) -> dict[str, Way]:
        """Return all ways that it has."""

        def asked(name: str) -> Way:
            return lambda: Measured(**self.ask(name))  # type: ignore[arg-type]

        return {name: asked(name) for name in WAYS if name not in self.lacking}

    def _answer(self) -> dict[str, object]:
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        if not line:
            raise SystemExit("The measured product ended; what it said stands above.")
        answer: dict[str, object] = json.loads(line)
        return answer

    def stop(self) -> None:
        """End the process."""
        assert self._process.stdin is not None
        self._process.stdin.close()
        self._process.wait()


@contextmanager
def product(case: Case, lanes: int, installed: Path | None = None) -> Iterator[Product]:
    """Run a product's process."""
    running = Product(case, lanes, installed)
    try:
        yield running
    finally:
        running.stop()


def install(wheel: Path, folder: Path) -> Path:
    """Install a wheel, without what it needs, into a folder of its own."""
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps"]
    subprocess.run([*pip, "--target", str(folder), str(wheel)], check=True)
    return folder


def take_turns(programs: Mapping[str, Mapping[str, Way]], turns: int) -> Samples:
    """Have all programs measure each way one after the other, in several turns.

    Every second turn they do so in the other order.
    """
    samples: Samples = {who: {name: [] for name in ways} for who, ways in programs.items()}
    for turn in range(turns):
        order = list(programs)[:: -1 if turn % 2 else 1]
        for name in WAYS:
            for who in order:
                if name in programs[who]:
                    samples[who][name].append(programs[who][name]())
    return samples
