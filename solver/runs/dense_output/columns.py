"""Columns of a run's accepted steps, as stores name them."""

from jointplay.solver.integrators import METHODS
from jointplay.solver.mechanics.assembly import assemble, shortest_link
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.runs.admission import Admission
from jointplay.solver.scene.pairs import contact_pairs
from jointplay.solver.scene.references import inner_states
from jointplay.solver.scene.time_scales import characteristic_time

METHOD = "method"
"""Last column: number of the method that made the step; see `number_of`."""


def methods() -> list[str]:
    """Return the methods in the order of their numbers; stores keep it, for registries grow."""
    return sorted(METHODS)


def number_of(method: str) -> float:
    """Return the number that steps of a method have in their last column."""
    return float(methods().index(method))


def method_of(number: float) -> str:
    """Return the method whose steps have a number."""
    return methods()[int(number)]


def needs_no_steps(admission: Admission) -> bool:
    """Whether drivers leave no freedom, so that the motion is known at any time as it is."""
    return assemble(admission.scene).freedom_with_play == 0


def step_columns(admission: Admission) -> tuple[str, ...]:
    """Return the columns of the steps that a run keeps; none if it keeps none.

    In the order of `solver.kernels.emit.slots.StepRow`, then the method. A run whose drivers leave
    no freedom makes no steps.
    """
    scene = admission.scene
    if not admission.steps_limit or needs_no_steps(admission):
        return ()
    coordinates: tuple[str, ...]
    if admission.job["formulation"] == "lagrange":
        coordinates = tuple(f"{b}.{axis}" for b in scene.bodies for axis in ("x", "y", "theta"))
    else:
        coordinates = spanning_tree(scene).coordinates
    speeds = [f"{name} rate" for name in coordinates]
    inner = [
        f"{name} inner {k}"
        for name, states in inner_states(scene).items()
        for k, _ in enumerate(states)
    ]
    pairs = list(contact_pairs(scene))
    return (
        *("period", "time", "length"),
        *(*coordinates, *speeds, *inner),
        *(f"{name} slope" for name in (*speeds, *inner)),
        *(f"{name} contact" for name in pairs),
        *(f"{name} impact rate" for name in pairs),
        METHOD,
    )


def period_of_steps(admission: Admission) -> float:
    """Return what a step's whole periods are of, s: of the drivers, or the scene's time scale."""
    scene = admission.scene
    return admission.period or characteristic_time(scene, shortest_link(scene))


def most_steps(admission: Admission) -> int:
    """Return how many steps a run keeps at most, within its limit of bytes."""
    columns = len(step_columns(admission))
    return admission.steps_limit // (8 * columns) if columns else 0
