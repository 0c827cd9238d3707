"""Studies that are known in closed form, to draw: the logistic map as a machine's sections."""

import numpy as np

from jointplay.records.channel import Channel
from jointplay.records.peak import PeakColumns
from jointplay.records.point import Failure, PointStatus
from jointplay.records.study import StudyDataset
from jointplay.solver.designs import DESIGNS

VERDICTS = ("undecided", "periodic", "quasi-periodic", "chaotic")
SCENE = {"name": "logistic", "bodies": {}, "joints": {"left": {"clearance": {}}}}
OBSERVED = (
    ("left.eccentricity_x", "m", 5e-4),
    ("left.eccentricity_y", "m", 2e-4),
    ("left.eccentricity_rate_x", "m/s", 0.05),
    ("left.eccentricity_rate_y", "m/s", 0.02),
    ("block.x", "m", 0.3),
    ("block.vx", "m/s", 2.0),
)
PERIOD = 2.0  # s


def logistic(growth, record, start=0.3, settle=500):
    """(points, record) iterates of x -> growth x (1 - x) after settling."""
    x = np.full(len(growth), start)
    rows = []
    for step in range(settle + record):
        x = growth * x * (1.0 - x)
        if step >= settle:
            rows.append(x)
    return np.array(rows).T


def exponents(growth):
    """(points,) Lyapunov exponents of the logistic map in 1/s, a step taking a period."""
    x = logistic(growth, 2000)
    return np.log(np.abs(growth[:, None] * (1.0 - 2.0 * x)) + 1e-12).mean(axis=1) / PERIOD


def bifurcation(
    points=120,
    record=50,
    *,
    low=1e-4,
    high=1e-3,
    logarithmic=False,
    judged=False,
    both=False,
    failed=(),
    unfinished=(),
):
    """Radial clearances from `low` to `high` that stand for growth rates of 2.9 to 4."""
    spaced = np.geomspace if logarithmic else np.linspace
    values = spaced(low, high, points)
    growth = 2.9 + 1.1 * (values - low) / (high - low)
    if both:
        values, growth = np.tile(values, 2), np.tile(growth, 2)
    status = np.full(len(values), PointStatus.done, dtype=np.uint8)
    status[list(failed)] = PointStatus.failed
    status[list(unfinished)] = PointStatus.running
    status[list(unfinished)[len(list(unfinished)) // 2 :]] = PointStatus.waiting
    x = logistic(growth, record + 1)
    x[status != PointStatus.done] = np.nan
    sections = {
        name: scale * (x[:, 1:] if "rate" in name or "v" in name else x[:, :-1])
        for name, _, scale in OBSERVED
    }
    if both:
        sections = {name: rows * np.repeat([1.0, 0.97], points)[:, None] for name, rows in
                    sections.items()}  # fmt: skip
    times = PERIOD * (100 + np.arange(1.0, record + 1)) + 0.0 * x[:, :-1]
    indicators, verdicts = {}, None
    if judged:
        exponent = np.where(status == PointStatus.done, exponents(growth), np.nan)
        verdicts = np.select(
            [status != PointStatus.done, exponent > 0.05, exponent < -0.02], [-1, 3, 1], default=0
        )
        verdicts[(verdicts == 1) & (growth > 2.95) & (growth < 3.0)] = 2
        indicators = {"lyapunov": exponent, "lyapunov_error": 0.02 + 0.0 * exponent}
    return StudyDataset(
        attributes={
            "job": {"kind": "bifurcation", "continuation": "both" if both else "none"},
            "scene": SCENE,
        },
        parameters=(Channel("play", "m", "radial clearance"),),
        values=values[:, None],
        status=status,
        observables=tuple(Channel(name, unit, name) for name, unit, _ in OBSERVED),
        times=times,
        section_values=sections,
        failures={
            point: Failure("step-size-underflow", "The step fell below 1e-15 s.", 0.7)
            for point in failed
        },
        statistics={"steps": np.full(len(values), 1000.0)},
        indicators=indicators,
        verdicts=verdicts,
        verdict_names=VERDICTS,
    )


def one_point(kind="poincare", members=1, record=400):
    """A quasi-periodic section: a closed curve, for each member from another start."""
    turns = np.arange(record) * (np.sqrt(5.0) - 1.0) / 2.0
    angle = 2.0 * np.pi * (turns[None, :] + np.linspace(0.0, 1e-3, members)[:, None])
    sections = {
        name: scale * ((np.cos if "rate" in name or "v" in name else np.sin)(angle))
        for name, _, scale in OBSERVED
    }
    return StudyDataset(
        attributes={"job": {"kind": kind}, "scene": SCENE},
        parameters=(),
        values=np.empty((members, 0)),
        status=np.full(members, PointStatus.done, dtype=np.uint8),
        observables=tuple(Channel(name, unit, name) for name, unit, _ in OBSERVED),
        times=np.broadcast_to(PERIOD * np.arange(1.0, record + 1), (members, record)),
        section_values=sections,
        verdict_names=VERDICTS,
    )


def sweep(sizes=(40,), *, failed=(), unfinished=()):
    """Peaks over one, two or three parameters: an even and an odd function of the first."""
    axes = [
        values
        for values, _ in zip(
            (
                np.linspace(1e-4, 1e-3, sizes[0]),
                np.geomspace(1e-2, 1.0, sizes[1] if len(sizes) > 1 else 1),
                np.linspace(1.0, 2.0, sizes[2] if len(sizes) > 2 else 1),
            ),
            sizes,
            strict=False,
        )
    ]
    values = np.stack([one.ravel() for one in np.meshgrid(*axes, indexing="ij")], axis=1)
    status = np.full(len(values), PointStatus.done, dtype=np.uint8)
    status[list(failed)] = PointStatus.failed
    status[list(unfinished)] = PointStatus.waiting
    force = 3e6 * values[:, 0] ** 1.5 * (values[:, 1] ** 0.3 if len(sizes) > 1 else 1e2) * 1e2
    force[status != PointStatus.done] = np.nan
    stroke = 0.528 - 2.0 * values[:, 0] + 0.0 * force
    moment = 0.1 + 0.0 * force
    return StudyDataset(
        attributes={
            "job": {"kind": "sweep"},
            "scene": SCENE,
            "meanings": {
                "left.normal_force.root_mean_square": ("N", "root mean square of normal force"),
                "left.contact_share": ("1", "share of the time in contact"),
            },
        },
        parameters=(
            Channel("play", "m", "radial clearance"),
            Channel("friction", "1", "coefficient of friction"),
            Channel("speed", "rad/s", "speed of the crank"),
        )[: len(sizes)],
        values=values,
        status=status,
        channels=(
            Channel("stroke", "m", "stroke"),
            Channel("left.normal_force", "N", "normal force"),
        ),
        extremes={
            "stroke": PeakColumns(stroke - 0.5, moment, stroke, moment),
            "left.normal_force": PeakColumns(0.0 * force, moment, force, moment),
        },
        failures={point: Failure("step-size-underflow", "No step.", 0.1) for point in failed},
        statistics={
            "steps": 1000.0 + 0.0 * force,
            "left.normal_force.root_mean_square": 0.1 * force,
            "left.contact_share": 1.0 / (1.0 + force / 1e4),
        },
    )


ORDERS = {"bogacki-shampine": 3, "tsitouras": 5, "dormand-prince-853": 8, "rodas": 4, "rk4": 4}


def calibration(*, ended=True, fitted=1.0, cost=1.0, settled=True):
    """A cost that falls tenfold, and two targets: a value that is missed by one, and a bound."""
    common = {"tolerance": 2.0, "lowest": 6.0, "highest": 14.0}
    targets = [
        common | {"value": 10.0, "between": None, "fitted": 12.0, "weight": 1.0},
        common | {"value": None, "between": [None, 10.0], "fitted": 8.0, "weight": fitted},
    ]
    found = {
        "targets": targets,
        "cost": cost,
        "equally_good_cost": 1.0,
        "search": {
            "best_costs": [None, 10.0, 2.0, 1.0],
            "settled": settled,
            "spread_settled": settled,
        },
    }
    return StudyDataset(
        attributes={"job": {"kind": "calibration"}, "scene": SCENE},
        parameters=(),
        values=np.empty((1, 0)),
        status=np.full(1, PointStatus.done if ended else PointStatus.running, np.uint8),
        documents={0: found} if ended else {},
    )


def accuracy_study(ended=None, *, lossless=False):
    """Methods whose error is a power of their evaluations; 1e-3 is refused, one run has failed."""
    runs = [{"method": "tsitouras", "reference": True, "admitted": True}] * 2
    runs += [
        {"method": method, "reference": False, "admitted": decade > 0}
        for method in ORDERS
        for decade in range(8)
    ]
    decades = np.array([0.0, 0.0, *np.tile(np.arange(8.0), len(ORDERS))])
    order = np.array([5, 5, *np.repeat(list(ORDERS.values()), 8)])
    error = 1e-3 * 0.1**decades
    error[:3] = np.nan, 1e-12, np.nan
    statistics = {
        "error": error,
        "evaluations": 1e3 * order * 10.0 ** (decades / order),
        "relative_energy_residual": np.full(len(runs), np.nan) if lossless else 0.1 * error,
    }
    status = np.full(len(runs), PointStatus.done, dtype=np.uint8)
    status[2] = PointStatus.failed
    if ended is not None:
        status[ended:] = PointStatus.waiting
        for column in statistics.values():
            column[ended:] = np.nan
    return StudyDataset(
        attributes={"job": {"kind": "accuracy-study"}, "scene": SCENE, "runs": runs},
        parameters=(),
        values=np.empty((len(runs), 0)),
        status=status,
        failures={2: Failure("fixed-step-too-long", "The step is too long.", 0.1)},
        statistics=statistics,
    )


def sensitivity(design="saltelli", rows=64, parameters=3, *, failed=(), constant=False):
    """A sum of parameters of which each weighs half of the one before, and the first two mix."""
    shares = DESIGNS[design](rows, parameters, 0).reshape(-1, parameters)
    status = np.full(len(shares), PointStatus.done, dtype=np.uint8)
    status[list(failed)] = PointStatus.failed
    stroke = 0.5 + 1e-3 * (shares @ 0.5 ** np.arange(parameters) + shares[:, 0] * shares[:, -1])
    stroke = np.where(status == PointStatus.done, 0.5 if constant else stroke, np.nan)
    return StudyDataset(
        attributes={
            "job": {"kind": "sensitivity", "design": design},
            "scene": SCENE,
            "meanings": {"left.contact_share": ("1", "share of the time in contact (joint left)")},
        },
        parameters=[
            Channel(f"clearance_{number}", "m", "radial clearance") for number in range(parameters)
        ],
        values=1e-4 + 4e-4 * shares,
        status=status,
        channels=(Channel("block.x", "m", "position of the block"),),
        extremes={"block.x": PeakColumns(-stroke, stroke, stroke, stroke)},
        statistics={"left.contact_share": 1000.0 * stroke - 500.0},
        failures={point: Failure("step-size-underflow", "It failed.", 0.7) for point in failed},
    )
