"""Run all measurements: ``python -m benchmarks [NAME ...]``, options behind the names."""

import importlib
import inspect
import sys
from collections.abc import Callable

ALL = (
    "dense",
    "digests",
    "press",
    "loop_share",
    "limit",
    "certificate",
    "peers",
    "accuracy",
    "stiffness",
    "knots",
    "exponent",
    "double_pendulum",
    "sweep",
    "chart",
    "chart_curves",
    "basins",
    "verdicts",
    "sensitivity",
    "continuation",
    "special_curves",
    "branches",
    "known_orbits",
    "microactuator",
    "limit_cycles",
    "pitchfork",
    "random_orbits",
    "continuation_cost",
    "device",
    "joined",
    "bucket",
    "restitution",
    "extremes",
    "drafts",
    "ledger",
    "contacts",
    "lies",
    "openings",
    "platform",
    "catalogue",
    "submission",
    "latency",
    "poses",
    "memory",
    "hostile",
    "attack",
    "single_attacks",
    "start",
    "first_frame",
    "first_hour",
    "compilation",
    "results_store",
    "results_http",
)


def has_options(command: Callable[[], object]) -> bool:
    """Return whether a measurement reads options of its own."""
    program = inspect.getsource(sys.modules[command.__module__])
    return "sys.argv" in program or "argparse" in program


def main() -> int:
    """Run the named measurements, or all."""
    given = sys.argv[1:]
    first = next((i for i, word in enumerate(given) if word.startswith("-")), len(given))
    names, options = given[:first] or ALL, given[first:]
    unknown = [name for name in names if name not in ALL]
    if unknown:
        print(f"there is no measurement {', '.join(unknown)}; there are {', '.join(ALL)}")
        return 2
    if not given[:first] and options in (["-h"], ["--help"]):
        print(f"{__doc__}\nThey are {', '.join(ALL)}.")
        return 0
    for name in names:
        command = importlib.import_module(f"benchmarks.{name}").main
        if options and not has_options(command):
            print(f"{inspect.getdoc(sys.modules[command.__module__])}\n\n{name} has no options.")
            return 0 if options in (["-h"], ["--help"]) else 2
        print(f"\n== {name}")
        sys.argv = [name, *options]
        command()
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
