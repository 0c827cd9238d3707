"""What a certificate costs: processor time of the press with and without one.

One and a hundred revolutions of the press as it is shipped, with the friction of the publication's
second part, and at 2.5 pi rad/s, where it impacts all the time. Runs with and without take turns;
the ratio is that of their medians.
"""

import statistics
import time
from typing import Any

from benchmarks.press import CASE
from solver.admission import Admission, admit
from solver.simulate import Simulation

PRESSES: dict[str, dict[str, float]] = {
    "as shipped": {},
    "friction 0.1": CASE | {"clearance": 5e-4},
    "friction 0.1, 2.5 pi rad/s": CASE | {"clearance": 5e-4, "speed": 7.853981633974483},
}
REPEATS = {1: 15, 100: 3}


def seconds(job: dict[str, Any]) -> float:
    """Return the processor time of a run's slices, s."""
    admission = admit(job)
    assert isinstance(admission, Admission)
    simulation = Simulation(admission)
    begun = time.thread_time()
    for _ in simulation.slices():
        pass
    return time.thread_time() - begun


def main() -> None:
    """Print times and ratios."""
    print("                            revolutions   without      with   ratio")
    for name, parameters in PRESSES.items():
        revolution = 2.0 * 3.141592653589793 / parameters.get("speed", 3.141592653589793)
        for revolutions, repeats in REPEATS.items():
            scene = {"preset": "seven-bar-press", "parameters": parameters}
            job = {"kind": "simulate", "scene": scene, "duration": revolutions * revolution}
            pairs = [(seconds(job | {"certificate": False}), seconds(job)) for _ in range(repeats)]
            without, with_one = (statistics.median(column) for column in zip(*pairs, strict=True))
            print(
                f"{name:30} {revolutions:8d} {1e3 * without:7.1f} ms {1e3 * with_one:6.1f} ms"
                f" {with_one / without:7.2f}"
            )


if __name__ == "__main__":
    main()
