"""Cost of a certificate: processor time of the press with and without one.

One and a hundred revolutions of the press as it is shipped, with the friction of the publication's
second part, and at 2.5 pi rad/s, where it impacts all the time. Runs with and without take turns;
the ratio is that of their medians, for what is computed in slices and for whole jobs: with the
kernel's equations traced, extremes and the certificate put together.
"""

import statistics
import time
from typing import Any

from benchmarks.press import CASE
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.runs.simulate import Simulation

PRESSES: dict[str, dict[str, float]] = {
    "as shipped": {},
    "friction 0.1": CASE | {"clearance": 5e-4},
    "friction 0.1, 2.5 pi rad/s": CASE | {"clearance": 5e-4, "speed": 7.853981633974483},
}
REPEATS = {1: 15, 100: 3}


def seconds(job: dict[str, Any]) -> tuple[float, float]:
    """Return the processor time of a run's slices, and of all from its start to its end, s."""
    admission = admit(job)
    assert isinstance(admission, Admission)
    begun = time.thread_time()
    simulation = Simulation(admission)
    ready = time.thread_time()
    for _ in simulation.slices():
        pass
    computed = time.thread_time()
    simulation.summary()
    simulation.certificate()
    return computed - ready, time.thread_time() - begun


def main() -> None:
    """Print times and ratios."""
    print("                            revolutions   without      with   ratio   of whole jobs")
    for name, parameters in PRESSES.items():
        revolution = 2.0 * 3.141592653589793 / parameters.get("speed", 3.141592653589793)
        for revolutions, repeats in REPEATS.items():
            scene = {"preset": "seven-bar-press", "parameters": parameters}
            job = {"kind": "simulate", "scene": scene, "duration": revolutions * revolution}
            pairs = [
                (*seconds(job | {"certificate": False}), *seconds(job)) for _ in range(repeats)
            ]
            bare, whole, bare_with, whole_with = (
                statistics.median(column) for column in zip(*pairs, strict=True)
            )
            print(
                f"{name:30} {revolutions:8d} {1e3 * bare:7.1f} ms {1e3 * bare_with:6.1f} ms"
                f" {bare_with / bare:7.2f} {whole_with / whole:15.2f}"
            )


if __name__ == "__main__":
    main()
