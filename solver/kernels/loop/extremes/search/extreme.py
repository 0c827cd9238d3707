"""The extreme of a function that is known at five equally spaced nodes: where a quartic turns."""

import numpy as np

from jointplay.solver.kernels.jit import inner_kernel, kernel
from jointplay.solver.kernels.loop.extremes.search.brackets import LAST, MIDDLE, NODES, TINY

MOST_ITERATIONS = 8
CLOSE = 1e-3
"""Change of the abscissa, in spacings, that ends the search: a value changes by its square."""
DOUBT = 0.1
"""Weight of the term that is left out: three times the most that it is between five nodes."""
ROUGH = 0.25
"""Ratio of differences, from one order to the next but one, beyond which no quartic is trusted."""
STEEP = 10.0
"""A slope at the end by more errors than that is no error: the function has no extreme inside."""
BENDING = 4.0
"""Times that a channel may leave the straight lines of a corner farther there than at a node."""
STEEPER = 4.0
"""Times its slope by which that may change in a step, where nodes do not tell."""
LEFT_OUT = 4.0
"""Slope of what a quartic leaves out, by its value, if not larger."""
BESIDE = 1e-6
"""Distance from one of the nodes at which what is left out there is nothing but rounding."""
ROUNDED = 1.5e-14
"""Share of a value that its fourth difference is rounded by, by `ROUGH`."""
TWELFTH = 1.0 / 12.0


@kernel()
def extreme(
    values: np.ndarray, best: int, sense: float, so_far: float, spacing: float
) -> tuple[float, float, float, float]:
    """Return the extreme (sense 1: maximum, -1: minimum) of a function about one of five nodes.

    No value beside that at the node `best` is beyond it.
    Where the extreme is, in spacings from the first node; its value; a bound on the value's error;
    and the second difference there, 0 at what may be a corner. A sample that nothing surpasses is
    as it is, and the bound then tells how far the function may go beyond it; so it is of a
    `corner`. What does not come near that `so_far` is not looked for. `spacing` : of the nodes, as
    a share of the step.
    """
    middle = values[MIDDLE]
    odd = values[3] - values[1]
    even = values[3] + values[1] - 2.0 * middle
    far_odd = values[4] - values[0]
    far_even = values[4] + values[0] - 2.0 * middle
    # the quartic's coefficients about the middle
    slope, bend = (8.0 * odd - far_odd) * TWELFTH, (8.0 * even - 0.5 * far_even) * TWELFTH
    twist, curl = (far_odd - 2.0 * odd) * TWELFTH, (0.5 * far_even - 2.0 * even) * TWELFTH
    # the ratio of a difference to the next but one, from whichever two are not small by chance
    second, third, fourth = 2.0 * abs(bend) + TINY, abs(6.0 * twist), abs(24.0 * curl)
    rounded = ROUNDED * abs(middle)
    shrinking = max(fourth / (second + third + rounded), third / (second + abs(slope) + rounded))
    error = DOUBT * (second + third) * shrinking * np.sqrt(shrinking)
    sample, abscissa = values[best], float(best - MIDDLE)
    if shrinking > ROUGH:  # maybe a corner: it goes on as steeply as to either side at most
        inner = min(max(best, 1), LAST - 1)
        rise, fall = values[inner] - values[inner - 1], values[inner] - values[inner + 1]
        error = max(error, max(abs(rise), abs(fall)))
    rests = best + 2 <= LAST and sample == values[best + 1] == values[best + 2]
    if not rests and best in (0, LAST):
        rate = slope + abscissa * (2.0 * bend + abscissa * (3.0 * twist + abscissa * 4.0 * curl))
        rests = sense * abscissa * rate > STEEP * error
    if rests:
        return float(best), sample, 0.0, second
    if not sense * sample + second + error > sense * so_far:
        return float(best), sample, error, second
    low, high = max(best - 1, 0) - MIDDLE, min(best + 1, LAST) - MIDDLE
    if shrinking > ROUGH:
        if best == MIDDLE:
            abscissa, off = corner(values, spacing)
            error, abscissa = min(error, off), min(max(abscissa, low), high)
        return abscissa + MIDDLE, sample, error, 0.0  # a value there tells no slope
    for _ in range(MOST_ITERATIONS):
        rate = slope + abscissa * (2.0 * bend + abscissa * (3.0 * twist + abscissa * 4.0 * curl))
        bent = 2.0 * bend + abscissa * (6.0 * twist + abscissa * 12.0 * curl)
        if not sense * bent < 0.0:
            return float(best), sample, error, second
        before = abscissa
        abscissa = min(max(abscissa - rate / bent, low), high)
        if abs(abscissa - before) < CLOSE:
            break
    value = middle + abscissa * (slope + abscissa * (bend + abscissa * (twist + abscissa * curl)))
    if abs(abscissa) == MIDDLE:
        value = sample
    return abscissa + MIDDLE, value, error, abs(bent)


@inner_kernel()
def corner(values: np.ndarray, spacing: float) -> tuple[float, float]:
    """Return where a function of five nodes has a corner next to the middle one, from there on.

    That is where straight lines through the two nodes at either end cross. Also how far it may be
    beyond the value in the middle: what it bends by shows there on one side, and on the other it is
    taken to bend by its slope in a part of a step.
    """
    middle, last = values[MIDDLE], values[LAST]
    rise, fall = values[1] - values[0], values[3] - last
    if not rise * fall > 0.0:
        return 0.0, np.inf
    crossing = (last - values[0] + LAST * fall) / (rise + fall)
    beyond = abs(values[0] + crossing * rise - middle)
    off = min(abs(middle - rise - values[1]), abs(middle - fall - values[3]))
    steeper = STEEPER * spacing * max(abs(rise), abs(fall))
    return crossing - MIDDLE, beyond + BENDING * off + steeper


@kernel()
def slope_left_out(abscissa: float, off: float) -> float:
    """Return the slope of what a quartic leaves out, by how much that is at an abscissa.

    Mostly that is a multiple of the quintic with roots at the five nodes: next to one of them it
    is small, however steep.
    """
    steeper = 0.0
    for i in range(NODES):
        if abs(abscissa - i) > BESIDE:
            steeper += 1.0 / (abscissa - i)
    return off * max(abs(steeper), LEFT_OUT)
