"""RODAS, Rosenbrock of order 4(3), six stages, stiffly accurate, dense output of order three.

Source: Hairer and Wanner 1996, Solving Ordinary Differential Equations II, IV.7 and IV.10.
"""

from jointplay.solver.integrators.method import Rosenbrock

# fmt: off
# (tables stay in rows)
_LAST = (1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950)
_WEIGHTS = (*_LAST, 1.0, 1.0)
_SECOND = (
    10.12623508344586, -7.487995877610167, -34.80091861555747, -7.992771707568823,
    1.025137723295662, 0.0,
)
_THIRD = (
    -0.6762803392801253, 6.087714651680015, 16.43084320892478, 24.76722511418386,
    -6.594389125716872, 0.0,
)

RODAS4 = Rosenbrock(
    name="rodas",
    order=4,
    error_order=4,
    dense_order=3,
    largest_tolerance=1e-6,
    usual_evaluations=241e3,
    cost_order=4.2,
    gamma=0.25,
    nodes=(0.0, 0.386, 0.21, 0.63, 1.0, 1.0),
    drifts=(0.25, -0.1043, 0.1035, -0.0362, 0.0, 0.0),
    matrix=(
        (),
        (1.544,),
        (0.9466785280815826, 0.2557011698983284),
        (3.314825187068521, 2.896124015972201, 0.9986419139977817),
        _LAST,
        (*_LAST, 1.0),
    ),
    couplings=(
        (),
        (-5.6688,),
        (-2.430093356833875, -0.2063599157091915),
        (-0.1073529058151375, -9.594562251023355, -20.47028614809616),
        (7.496443313967647, -10.24680431464352, -33.99990352819905, 11.70890893206160),
        (
            8.083246795921522, -7.981132988064893, -31.52159432874371, 16.31930543123136,
            -6.058818238834054,
        ),
    ),
    weights=_WEIGHTS,
    error=(0.0, 0.0, 0.0, 0.0, 0.0, 1.0),
    # θ Δ + θ (1 - θ) (second + θ third)
    dense=(
        (0.0, 0.0, 0.0),
        *((w + a, b - a, -b) for w, a, b in zip(_WEIGHTS, _SECOND, _THIRD, strict=True)),
    ),
)
