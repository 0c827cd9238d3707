"""Attacks by name, and the table of what they did."""

import argparse
import os
import tempfile
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import NamedTuple

from benchmarks.limit.turns import install
from benchmarks.single_attacks import on_clocks, on_connections, on_files, on_owners, on_workers
from benchmarks.single_attacks.attacked import Attacked, attacked


class Kind(NamedTuple):
    """An attack, what it is called, and further variables of the service."""

    called: str
    act: Callable[[Attacked], str]
    variables: dict[str, str] = {}
    disk: int = 0
    """Bytes of a file system for the data; 0: that of the folder."""


ATTACKS = {
    "idle": Kind("1 idle connections", on_connections.idle, {"JOINTPLAY_MAX_ATTEMPTS": "3"}),
    "bodies": Kind("2 unfinished bodies", on_connections.bodies),
    "finish": Kind("3 `finish` of what is not there", on_workers.finish),
    "parts": Kind("4 another block's files", on_workers.parts),
    "uploads": Kind("5 uploads", on_workers.uploads, disk=400 * 10**6),
    "batches": Kind("6 slow batches of one owner", on_owners.batches),
    "streams": Kind("7 streams of one owner", on_owners.streams),
    "zip": Kind("8 damaged `zarr.zip`", on_files.damaged_store),
    "catalogue": Kind("9 a catalogue that cannot be written", on_files.catalogue),
    "refusals": Kind("10 refused connections", on_connections.refusals),
    "clock": Kind(
        "11 a worker whose clock is late", on_clocks.late, {"JOINTPLAY_MAX_ATTEMPTS": "50"}
    ),
    "folders": Kind("12 two data folders", on_files.second_folder),
    "rates": Kind("12 rates", on_owners.rates, {"JOINTPLAY_RATE": "20"}),
    "browsers": Kind("12 policy, Host", on_connections.browsers, {"JOINTPLAY_KEYS": "none"}),
}


def measured(attack: Kind, kind: str, program: Path | None) -> str:
    """Return what an attack does to a service of a kind."""
    with tempfile.TemporaryDirectory() as made, ExitStack() as stack:
        folder = Path(made)
        if attack.disk:
            stack.enter_context(on_files.small_disk(folder / "data", attack.disk))
        service = stack.enter_context(attacked(kind, folder, program, attack.variables))
        try:
            return attack.act(service)
        except Exception as error:  # noqa: BLE001 - of an earlier program anything may be
            return f"broken off: {error!r}"


def main() -> None:
    """Print a row for every attack."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks single_attacks")
    parser.add_argument("--beside", type=Path, metavar="WHEEL", help="an earlier version")
    parser.add_argument("--only", default=",".join(ATTACKS), help="names of attacks")
    parser.add_argument("--kinds", default="folder,bucket", help="of services")
    asked = parser.parse_args()
    kinds = asked.kinds.split(",")
    with tempfile.TemporaryDirectory() as made:
        programs: dict[str, Path | None] = {"now": None}
        if asked.beside:
            programs = {"before": install(asked.beside, Path(made) / "wheel"), **programs}
        print(f"load of the machine {os.getloadavg()[0]:.1f}")
        columns = [(who, kind) for kind in kinds for who in programs]
        print("| attack |" + "".join(f" {kind}, {who} |" for who, kind in columns))
        print("|---|" + "---|" * len(columns))
        for name in asked.only.split(","):
            attack = ATTACKS[name]
            row = [measured(attack, kind, programs[who]) for who, kind in columns]
            print(f"| {attack.called} | " + " | ".join(row) + " |", flush=True)
    print(f"load of the machine {os.getloadavg()[0]:.1f}")
