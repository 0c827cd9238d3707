"""Steps that are postponed since samples have no room: made again, they are the same."""

import numpy as np
import pytest

from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.loop.runs import SAMPLES
from jointplay.solver.lanes import bundle as bundles
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.scene.document import Scene

COUNT, DURATION, KNOTS = 20_001, 1.0, 40


def scene() -> Scene:
    """Return a block that slides past knots of a force over its place, at no even distances."""
    places = np.cumsum(np.random.default_rng(5).uniform(0.005, 0.05, KNOTS))
    course = {"type": "table", "between": "monotone", "outside": "held"}
    course |= {"knots": places.tolist(), "values": np.cos(9.0 * places).tolist()}
    force = {"type": "force", "magnitude": 1.0, "direction": [1.0, 0.0], "course": course}
    force |= {"first": "ground.O", "second": "block.O", "over": {"quantity": "x"}}
    origin = {"points": {"O": [0.0, 0.0]}}
    slide = {"type": "prismatic", "guide": "ground.O", "slider": "block.O", "axis": [1.0, 0.0]}
    return Scene.model_validate(
        {
            "name": "pushed",
            "ground": origin,
            "bodies": {"block": {"mass": 1.0, "inertia": 1.0} | origin},
            "joints": {"slide": slide},
            "forces": {"push": force},
            "start": {"velocities": {"block": [1.0, 0.0]}},
        }
    )


def samples(room: int, monkeypatch: pytest.MonkeyPatch) -> tuple[np.ndarray, int]:
    """Return all samples of a run whose buffer has room for so many, and its steps."""
    monkeypatch.setattr(bundles, "ROWS_AT_ONCE", room)
    pushed = scene()
    problem = LaneProblem(pushed, DURATION, 1e-6, DURATION / (COUNT - 1), COUNT, 0, 0.0)
    bundle = Bundle(ready_kernel(pushed, "minimal", "tsitouras"), [problem])
    rows, running = [], 1
    while running:
        running = bundle.advance(10**6)
        rows.append(bundle.rows(SAMPLES, 0).copy())
    return np.concatenate(rows), bundle.lane(0).steps


def test_a_run_past_knots_has_the_same_bits_whatever_room_its_samples_have(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    wanted, steps = samples(COUNT, monkeypatch)
    assert len(wanted) == COUNT
    found, others = samples(9, monkeypatch)  # nearly every step is postponed
    assert others == steps
    np.testing.assert_array_equal(found, wanted)
