"""A slip that passes a bend of friction in a step and comes back, or two, is told by its ends."""

import numpy as np
import pytest

from jointplay.solver.kernels.emit.bends import BEYOND, RATES
from jointplay.solver.kernels.emit.closer_looks import EVERY
from jointplay.solver.kernels.emit.judging import PACE, PASSING, SWINGING
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.target import own_target
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.presets import document

BENDS = np.array([0.3, 0.5])
"""m/s; slips and their changes are about as large."""
DRAWS = 400
SHARES = np.linspace(0.0, 1.0, 2001)


@pytest.fixture(scope="module")
def kernel() -> Kernel:
    return ready_kernel(Scene.model_validate(document("slider-crank")), "reduced", "tsitouras")


def levels(slips: np.ndarray) -> np.ndarray:
    """Return how many bends, either way, each slip is above."""
    return sum((np.asarray(slips > bend, int) for bend in (*BENDS, *-BENDS)), np.zeros((), int))


def cubic(before: float, now: float, begin: float, end: float) -> np.ndarray:
    """Return the slips of a step, by values and changes over the step at its ends."""
    t, change = SHARES, now - before
    curving, bending = 3.0 * change - 2.0 * begin - end, begin + end - 2.0 * change
    return before + t * (begin + t * (curving + t * bending))


def hidden(slips: np.ndarray) -> bool:
    """Whether ends do not show all bends that are passed: one returns, or there are two."""
    found = levels(slips)
    ends = sorted((found[0], found[-1]))
    return bool(found.min() < ends[0] or found.max() > ends[1] or ends[1] - ends[0] > 1)


def test_no_bend_is_missed_and_none_is_foreseen_that_is_out_of_reach(kernel: Kernel) -> None:
    random, lanes = np.random.default_rng(1), own_target().lanes
    work, layout = np.zeros((kernel.layout.size, lanes)), kernel.layout
    work[layout.block("bend")] = BENDS[:, None]
    work[layout["mode0"]] = 1.0
    work[layout["tried"]] = step = 1e-3
    missed = foreseen = needless = 0
    for _ in range(DRAWS):
        before, now = random.uniform(-0.7, 0.7, (2, lanes))
        begin, end = random.normal(0.0, 0.6, (2, lanes))
        for name, values in (("slip_start0", before), ("slip0", now)):
            work[layout[name]] = values
        for name, values in (("slip_rate_start0", begin), ("slip_rate0", end)):
            work[layout[name]] = values / step
        kernel.module.foresee_bends(work)
        for lane in range(lanes):
            told = work[layout["may_pass_bend"], lane] > 0.0
            ends = np.array([before[lane], now[lane]])
            slips = cubic(*ends, begin[lane], end[lane])
            missed += hidden(slips) and not told
            foreseen += told
            margin = RATES * (abs(begin[lane]) + abs(end[lane]))
            low = ends.min() - (1.0 + BEYOND) * (ends.min() - slips.min()) - margin
            high = ends.max() + (1.0 + BEYOND) * (slips.max() - ends.max()) + margin
            # what is sampled falls short of the cubic's own extremes by less than a millionth
            needless += told and not hidden(np.array([ends[0], low - 1e-6, high + 1e-6, ends[1]]))
    assert (missed, needless) == (0, 0)
    assert 0.2 < foreseen / (DRAWS * lanes) < 0.9  # both happen


def test_what_is_apart_passes_none(kernel: Kernel) -> None:
    work, layout = np.zeros((kernel.layout.size, own_target().lanes)), kernel.layout
    work[layout.block("bend")] = BENDS[:, None]
    work[layout["slip_start0"]], work[layout["slip0"]] = -1.0, 1.0
    for mode in (0.0, 1.0):
        work[layout["mode0"]] = mode
        kernel.module.foresee_bends(work)
        assert ((work[layout["may_pass_bend"]] > 0.0) == (mode > 0.0)).all()


def test_looks_are_foreseen_wherever_bends_are(kernel: Kernel) -> None:
    """One lane at a time: the others are apart, so that what is told is told of it."""
    random, lanes = np.random.default_rng(2), own_target().lanes
    work, layout = np.zeros((kernel.layout.size, lanes)), kernel.layout
    work[layout.block("bend")] = BENDS[:, None]
    work[layout["tried"]] = 1.0
    passing = quiet = 0
    for draw in range(2000):
        work[layout["mode0"]] = np.arange(lanes) == draw % lanes
        far = 10.0 ** random.uniform(-3.0, 0.0)
        work[layout["slip_start0"]] = random.uniform(-0.7, 0.7, lanes)
        work[layout["slip0"]] = work[layout["slip_start0"]] + random.normal(0.0, far, lanes)
        for name in ("slip_rate_start0", "slip_rate0"):  # of lanes apart none turns
            work[layout[name]] = random.normal(0.0, 2.0 * far, lanes) * work[layout["mode0"]]
        foreseen = kernel.module.foresee_looks(work) != 0
        kernel.module.foresee_bends(work)
        bends = bool((work[layout["may_pass_bend"]] > 0.0).any())
        assert foreseen or not bends
        passing, quiet = passing + bends, quiet + (not foreseen)
    assert passing > 200
    assert quiet > 400  # it is worth asking


@pytest.mark.parametrize(
    ("mode", "begin", "end", "foreseen"),
    [
        (0.0, -1.0, 2.0, True),
        (0.0, 1.0, -2.0, True),
        (0.0, 1.0, 2.0, False),
        (0.0, 0.0, 2.0, False),
        (1.0, -1.0, 2.0, False),  # far from bends
    ],
)
def test_looks_are_foreseen_where_a_slip_turns_in_flight(
    kernel: Kernel, mode: float, begin: float, end: float, *, foreseen: bool
) -> None:
    work, layout = np.zeros((kernel.layout.size, own_target().lanes)), kernel.layout
    work[layout.block("bend")] = 1e3
    work[layout["tried"]], work[layout["mode0"]] = 1.0, mode
    work[layout["slip_rate_start0"]], work[layout["slip_rate0"]] = begin, end
    assert (kernel.module.foresee_looks(work) != 0) == foreseen


@pytest.mark.parametrize(
    ("slot", "steps", "value", "foreseen"),
    [
        ("flag", 100.0, float(2 * PACE - 1), False),
        ("flag", 100.0, float(PASSING), True),
        ("flag", 100.0, float(SWINGING), True),
        ("rough_until", 100.0, 100.0, False),
        ("rough_until", 100.0, 101.0, True),
        ("steps", 0.0, EVERY - 2.0, False),
        ("steps", 0.0, EVERY - 1.0, True),
        ("steps", 0.0, 7.0 * EVERY - 1.0, True),
        ("steps", 0.0, 7.0 * EVERY, False),
    ],
)
def test_looks_are_foreseen_where_steps_say_so(
    kernel: Kernel, slot: str, steps: float, value: float, *, foreseen: bool
) -> None:
    lanes = own_target().lanes
    for lane in range(lanes):
        work, layout = np.zeros((kernel.layout.size, lanes)), kernel.layout
        work[layout.block("bend")] = np.inf
        work[layout["mode0"]], work[layout["steps"]] = 1.0, steps
        work[layout[slot], lane] = value
        assert kernel.module.foresee_looks(work) == (foreseen << lane)
