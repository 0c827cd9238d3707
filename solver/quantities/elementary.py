"""Sine, cosine, power, logarithm and exponential as arithmetic: the same bits on every processor.

C libraries and NumPy choose other polynomials for other processors, and round other last bits.
These are sums, products and quotients alone, each rounded as it is written: on floats, on arrays
and, traced, in kernels, where one call into a library for one lane would cost more than these
polynomials do for eight lanes together. (There sums of products are rounded once.)

`coarse_log2` and `coarse_exp2` are exact to five digits, for the control of steps: the next step
waits for them, and no step size is known to five digits. Their pairs of terms are evaluated side
by side, in a quarter of the time of the others.
"""

import math
from collections.abc import Callable
from typing import Any

import numpy as np

LOWEST, HIGHEST = -1022.0, 1023.0
"""Exponents of the smallest normal number and of the largest."""
ON_FLOATS: dict[str, Callable[..., Any]] = {
    "floor": lambda x: float(math.floor(x)) if math.isfinite(x) else x,
    "select": lambda x, a, b: a if x > 0.0 else b,
    "exponent_of": lambda x: float(math.frexp(x)[1] - 1),
    "mantissa_of": lambda x: 2.0 * math.frexp(x)[0],
    "power_of_two": lambda x: math.ldexp(1.0, int(min(max(x, LOWEST), HIGHEST))),
    "quarter_turns": lambda n, sine, cosine: (sine, cosine, -sine, -cosine)[int(n) % 4],
}
ON_ARRAYS: dict[str, Callable[..., Any]] = {
    "floor": np.floor,
    "select": lambda x, a, b: np.where(x > 0.0, a, b),
    "exponent_of": lambda x: np.frexp(x)[1] - 1.0,
    "mantissa_of": lambda x: 2.0 * np.frexp(x)[0],
    "power_of_two": lambda x: np.ldexp(1.0, np.fmin(np.fmax(x, LOWEST), HIGHEST).astype(np.int64)),
    "quarter_turns": lambda n, sine, cosine: (
        np.where(n % 2.0 == 1.0, cosine, sine) * np.where(n % 4.0 >= 2.0, -1.0, 1.0)
    ),
}
"""Exact operations, on floats and on arrays; `solver.kernels.trace.operations` has it on lanes."""


def operate(name: str, x: Any, *others: Any) -> Any:
    """Return what an operation gives, of floats, of arrays or of expressions."""
    if isinstance(x, float):
        return ON_FLOATS[name](x, *others)
    if isinstance(x, np.ndarray):
        return ON_ARRAYS[name](x, *others)
    return x.tracer.apply(name, x, *others)


def _chosen(x: Any, if_positive: Any, otherwise: Any) -> Any:
    if isinstance(x, float | np.ndarray):
        return operate("select", x, if_positive, otherwise)
    return x.select_positive(if_positive, otherwise)


TWO_OVER_PI = 0.6366197723675814
HALF_PI = (1.5707963267341256, 6.0771005065061922e-11)
"""pi/2 in two parts (Cody-Waite): the first has 33 bits, so n times it is exact for n below 2^20;
the second errs by 1e-26, so angles up to 1e6 rad are reduced to within 1e-20 rad."""

SINE = (
    -1.66666666666666324348e-01,
    8.33333333332248946124e-03,
    -1.98412698298579493134e-04,
    2.75573137070700676789e-06,
    -2.50507602534068634195e-08,
    1.58969099521155010221e-10,
)
COSINE = (
    4.16666666666666019037e-02,
    -1.38888888888741095749e-03,
    2.48015872894767294178e-05,
    -2.75573143513906633035e-07,
    2.08757232129817482790e-09,
    -1.13596475577881948265e-11,
)
"""Minimax coefficients on [-pi/4, pi/4] (fdlibm, Sun Microsystems 1993)."""


def polynomial(x: Any, coefficients: tuple[float, ...]) -> Any:
    """Return the sum of coefficients times powers of x, the lowest first."""
    total: Any = coefficients[-1]
    for coefficient in reversed(coefficients[:-1]):
        total = total * x + coefficient
    return total


def of_six(z: Any, w: Any, c: tuple[float, ...]) -> Any:
    """Polynomial of degree 5 in z, w = z²: pairs side by side, for what follows waits for it."""
    return ((c[0] + c[1] * z) + w * (c[2] + c[3] * z)) + (w * w) * (c[4] + c[5] * z)


def sine_cosine(x: Any) -> tuple[Any, Any]:
    """Sine and cosine for angles up to 1e6 rad, within two units in the last place of 1."""
    n = operate("floor", x * TWO_OVER_PI + 0.5)
    r = (x - n * HALF_PI[0]) - n * HALF_PI[1]
    z = r * r
    w = z * z
    sine = r + (r * z) * of_six(z, w, SINE)
    cosine = (1.0 - 0.5 * z) + w * of_six(z, w, COSINE)
    turned = operate("quarter_turns", n, sine, cosine)
    return turned, operate("quarter_turns", n + 1.0, sine, cosine)


LARGEST_ANGLE = 1e6


def within_reach(x: Any) -> Any:
    """Return an angle or an array of angles, less whole turns if too large for `sine_cosine`.

    By then it is itself rounded by more than what its turns are wrong by. Infinite: ValueError, and
    NaN in an array.
    """
    if isinstance(x, float):
        return x if abs(x) <= LARGEST_ANGLE else math.fmod(x, 2.0 * math.pi)
    return np.where(np.abs(x) <= LARGEST_ANGLE, x, np.fmod(x, 2.0 * math.pi))


LOG2_E = 1.4426950408889634
LN_2 = 0.6931471805599453
ATANH_SERIES = tuple(1.0 / (2 * k + 1) for k in range(11))
"""atanh(f) / f in f²; at the interval's end f = 0.172 the next term is 1e-18."""
EXPONENTIAL_SERIES = tuple(1.0 / math.factorial(k) for k in range(14))
"""exp(x) for |x| <= ln(2)/2; the next term is 4e-18."""
SMALLEST = 1e-300


def log2(x: Any) -> Any:
    """Base-2 logarithm of x > 0, within 4e-16 of max(1, |log2 x|)."""
    exponent, mantissa = operate("exponent_of", x), operate("mantissa_of", x)
    upper = mantissa - math.sqrt(2.0)
    mantissa = _chosen(upper, 0.5 * mantissa, mantissa)
    exponent = _chosen(upper, exponent + 1.0, exponent)
    f = (mantissa - 1.0) / (mantissa + 1.0)
    return exponent + (2.0 * LOG2_E) * f * polynomial(f * f, ATANH_SERIES)


def exp2(x: Any) -> Any:
    """2 ** x, relative error within 4e-16 for |x| < 1000."""
    whole = operate("floor", x + 0.5)
    fraction = polynomial((x - whole) * LN_2, EXPONENTIAL_SERIES)
    return fraction * operate("power_of_two", whole)


def log(x: Any) -> Any:
    """Natural logarithm of a normal x > 0, within 4e-16 of max(1, |log2 x|)."""
    return LN_2 * log2(x)


def exp(x: Any) -> Any:
    """Exponential of x below 700; the relative error is about 1e-16 * max(1, |x|)."""
    return exp2(LOG2_E * x)


def power(x: Any, exponent: Any) -> Any:
    """Return x ** exponent for x >= 0; zero stays zero.

    The relative error is about 1e-16 * exponent * |log2 x|.
    """
    above = _chosen(x - SMALLEST, x, SMALLEST)
    return _chosen(x - SMALLEST, exp2(exponent * log2(above)), 0.0)


LOG2 = (
    -2.80036151819775,
    5.091701861936315,
    -3.550780387547957,
    1.631140112933141,
    -0.41656074565582785,
    0.044873215918604874,
)
"""Least largest error on [1, 2]: 1.26e-5 (reweighted least squares)."""
EXP2 = (
    1.0000000754895935,
    0.6931472254009747,
    0.24022107374248725,
    0.055502973101532,
    0.009676036361151113,
    0.0013410001381591824,
)
"""Least largest error on [-1/2, 1/2]: 1.1e-7, at the ends."""


def coarse_log2(x: Any) -> Any:
    """Base-2 logarithm of a normal x > 0, within 1.3e-5."""
    exponent, mantissa = operate("exponent_of", x), operate("mantissa_of", x)
    return exponent + of_six(mantissa, mantissa * mantissa, LOG2)


def coarse_exp2(x: Any) -> Any:
    """2 ** x, relative error within 1.2e-7 for |x| < 1000."""
    whole = operate("floor", x + 0.5)
    fraction = x - whole
    return of_six(fraction, fraction * fraction, EXP2) * operate("power_of_two", whole)
