"""Checks of redundant constraints: those that agree for good are run, others told with joints."""

from collections.abc import Iterable

import numpy as np

from jointplay.records.failure import InvalidInput, Problem
from jointplay.solver.mechanics.assembly import (
    ASSEMBLED,
    Assembly,
    assemble,
    poses_nearby,
    shortest_link,
)
from jointplay.solver.mechanics.conflicting_drivers import conflicting_drivers
from jointplay.solver.mechanics.redundancy import SelfStress, self_stresses
from jointplay.solver.runs.ideal.agreement import drivers_agree
from jointplay.solver.runs.ideal.turn import turn
from jointplay.solver.scene.document import Scene

CONSISTENT = 1e-9
"""Share of the largest velocity up to which rates of constraints are rounding, m/s and rad/s alike:
bodies are shorter than 1e6 m, so that the rounding of neither comes to that share of the other."""
MOST_NAMED = 8
"""Joints that a sentence names."""


def closes(scene: Scene) -> bool:
    """Return whether the ideal mechanism can be put together from its start."""
    return assemble(scene).residual / shortest_link(scene) <= ASSEMBLED


def redundant_while_held(scene: Scene, assembly: Assembly) -> bool:
    """Whether constraints are redundant at the start alone, where journals are held: as of a stop.

    A mechanism is put together with its journals held, and then let go: what they repeat of
    other joints does no harm if it agrees with them.
    """
    return bool(
        assembly.redundant
        and not assembly.freedom
        and not assembly.redundant_with_play
        and closes(scene)
        and assembly.rate <= CONSISTENT * float(np.abs(assembly.velocity).max())
    )


def check_redundant(scene: Scene, assembly: Assembly) -> None:
    """Refuse redundant constraints, unless the mechanism moves and they stay so, and agree."""
    if not assembly.freedom:
        check_drivers(scene)
        if _stay_redundant(scene, assembly):
            return
        raise _over_constrained(scene, assembly)
    ranks = [rank for _, residual, rank in poses_nearby(scene) if residual <= ASSEMBLED]
    if ranks and max(ranks) <= assembly.rank:
        if drivers_agree(scene):
            return
        check_drivers(scene)
        raise _over_constrained(scene, assembly)
    twice = [found for found in self_stresses(scene) if found.is_one_sided]
    if twice and (ranks or all(found.ends for found in twice)):
        raise InvalidInput(Problem("/scene/joints", _held_twice(found)) for found in twice)
    if ranks:
        raise InvalidInput.at(
            "/scene/start/angles",
            "The mechanism starts where it can go on in more than one assembly, so that its motion"
            " is not determined; give start angles of another pose.",
        )
    check_drivers(scene)
    raise _over_constrained(scene, assembly)


def _stay_redundant(scene: Scene, assembly: Assembly) -> bool:
    """Whether redundant constraints of a driven mechanism agree in a turn, and beside its start."""
    turned = turn(scene)
    if not scene.drivers or (turned is not None and not turned.agrees):  # None: drivers stand
        return False
    if not assembly.redundant_with_play:
        return not assembly.freedom_with_play
    rank = assembly.constraints - assembly.redundant_with_play
    loose = poses_nearby(scene, close_play=False) if assembly.freedom_with_play else ()
    return all(found == rank for _, residual, found in loose if residual <= ASSEMBLED)


def _held_twice(found: SelfStress) -> str:
    """Return what holds what another holds, to first derivatives only, and what would do."""
    others = _in_words(name for name in found.joints if name not in found.ends)
    if not found.ends:
        return (
            f"The joints {others} hold one another, and only so far as second derivatives, in every"
            " pose near the start: the motion is not determined. Let one of them go where it is"
            " held, as a pin in a slot does."
        )
    pins, either = _in_words(found.ends), _in_words(found.ends, "or")
    return (
        f"The joints {pins} of '{found.member}' hold along their line what {others} hold already:"
        " to first derivatives one of them is too many, in every pose, so that the motion is not"
        f" determined. Let {either} be a pin in a slot along that line."
    )


def _over_constrained(scene: Scene, assembly: Assembly) -> InvalidInput:
    count = max(assembly.redundant, assembly.redundant_with_play)
    named = dict.fromkeys(name for found in self_stresses(scene) for name in found.joints)
    return InvalidInput.at(
        "/scene/joints",
        f"The mechanism is over-constrained: {count} of {assembly.constraints}"
        f" constraint equations are redundant, among those of {_in_words(named)}; remove a joint or"
        " driver, or give one joint clearance.",
    )


def _in_words(names: Iterable[str], last: str = "and") -> str:
    quoted = [f"'{name}'" for name in names]
    if len(quoted) > MOST_NAMED:
        quoted = [*quoted[: MOST_NAMED - 1], f"{len(quoted) - MOST_NAMED + 1} others"]
    return f" {last} ".join([", ".join(quoted[:-1]), quoted[-1]] if quoted[1:] else quoted)


def check_drivers(scene: Scene) -> None:
    """Refuse (InvalidInput) drivers that prescribe one motion twice."""
    conflicting = conflicting_drivers(scene)
    if conflicting:
        names = " and ".join(f"'{name}'" for name in conflicting)
        count = len(scene.drivers)
        drop = f"one of the {count} drivers" if count > 1 else "the driver"
        raise InvalidInput.at(
            "/scene/drivers",
            f"The motion of {names} is prescribed twice: by its driver, and by the joints and the"
            f" other drivers. Drop {drop}, or give a joint clearance.",
        )
