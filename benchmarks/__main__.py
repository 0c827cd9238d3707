"""Run all measurements: ``python -m benchmarks [NAME ...]``, options behind the names."""

import importlib
import sys

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


def main() -> int:
    """Run the named measurements, or all."""
    given = sys.argv[1:]
    first = next((i for i, word in enumerate(given) if word.startswith("-")), len(given))
    names, options = given[:first] or ALL, given[first:]
    unknown = [name for name in names if name not in ALL]
    if unknown:
        print(f"there is no measurement {', '.join(unknown)}; there are {', '.join(ALL)}")
        return 2
    for name in names:
        print(f"\n== {name}")
        sys.argv = [name, *options]
        importlib.import_module(f"benchmarks.{name}").main()
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
