"""Linear equations of a step: factors and solutions, against NumPy's."""

import numpy as np

from jointplay.solver.kernels.emit.module import load
from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.target import own_target

LANES = own_target().lanes

N, GAMMA = 4, 0.25
TRIED, TIME, DIRECTION, PRODUCT, DRIFT, RIGHT, PIVOT, FACTOR = 0, 1, 2, 6, 10, 14, 18, 22
SLOTS = FACTOR + N * N
MATRIX = np.array([[1.0, -2, 0, 4], [3, 5, -1, 0], [0, 2, 7, 1], [1, 0, 2, -6]])
DRIFTS = np.array([0.5, -1.5, 2.5, -3.5])


def multiplying() -> str:
    """Return a tape of the product of the matrix with the direction, and a drift with time."""
    lines = [f"d{j} = load {DIRECTION + j}" for j in range(N)] + [f"t = load {TIME}"]
    for i in range(N):
        lines.append(f"s{i} = mul t {DRIFTS[i]}")
        for j in range(N):
            before = f"s{i}" if j == 0 else f"a{i}_{j - 1}"
            lines += [f"p{i}_{j} = mul d{j} {MATRIX[i, j]}", f"a{i}_{j} = add {before} p{i}_{j}"]
        lines.append(f"store {PRODUCT + i} a{i}_{N - 1}")
    return tuple(lines)


def test_each_lane_solves_its_own_equations() -> None:
    module = load(
        [
            Source("product", multiplying()),
            Source("factorise", (f"jacobian {N} {GAMMA} {TRIED} {TIME}",)),
            Source("solve", (f"solve {N} {TIME}",)),
        ]
    )
    work = np.full((SLOTS, LANES), np.nan)
    steps = work[TRIED] = 0.01 * np.arange(1.0, LANES + 1.0)
    right = work[RIGHT : RIGHT + N] = np.arange(1.0, 1.0 + N * LANES).reshape(N, LANES)
    right = right.copy()
    module.factorise(work)
    module.solve(work)
    assert work[DRIFT : DRIFT + N].tolist() == np.repeat(DRIFTS[:, None], LANES, axis=1).tolist()
    for lane, step in enumerate(steps):
        expected = np.linalg.solve(np.eye(N) - step * GAMMA * MATRIX, right[:, lane])
        # rounding of some ten operations a number, of matrices whose condition is below 3
        assert np.allclose(work[RIGHT : RIGHT + N, lane], expected, rtol=1e-13, atol=0.0)
