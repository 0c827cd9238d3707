"""Limits of a point's verdict: what the indicators cannot tell, and which number it depends on.

An indicator says nothing where it has too few sections, or where its number is infinite.
"""

import math
from collections.abc import Iterator, Mapping

from jointplay.solver.mechanics.assembly import link_lengths
from jointplay.solver.nonlinear.recurrence import longest_in
from jointplay.solver.nonlinear.verdict import UNDECIDED
from jointplay.solver.nonlinear.zero_one import FEWEST_TELLING
from jointplay.solver.runs.study.indicators import (
    FEWEST_FOR_RECURRENCE,
    FEWEST_FOR_SPECTRUM,
    RECURS,
)
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.pairs import contact_pairs
from jointplay.solver.scene.periods import moves_in_time
from jointplay.solver.scene.references import tangent_obstacle


def limits(
    scene: Scene, found: Mapping[str, float], sections: int, periods: int, *, events: bool = False
) -> Iterator[str]:
    """Yield what indicators cannot tell.

    found : the indicators of a point by name, those that were chosen and could be computed.
    sections : number of sections that they were found from. periods : whole periods among them,
    which those at onsets need not have. events : whether sections are at events.
    """
    yield from _limits_of_exponent(scene, found, periods)
    if "zero_one" in found and sections < FEWEST_TELLING:
        yield f"the 0-1 test needs {FEWEST_TELLING} sections to tell, there are {sections}"
    if "period" in found and sections < FEWEST_FOR_RECURRENCE:
        yield f"recurrence needs {FEWEST_FOR_RECURRENCE} sections, there are {sections}"
    elif "period" in found:
        scale = "1 m, as there is no link" if not link_lengths(scene) else "the shortest link"
        scale = "the finest clearance" if contact_pairs(scene) else scale
        scale = scale if scene.length is None else f"the scene's length of {scene.length:g} m"
        yield (
            f"periods up to {longest_in(sections)} are looked for, and what differs by less"
            f" than {RECURS:g} of {scale}, or of its own range, counts as the same"
        )
    if math.isnan(found.get("rotation", 0.0)):
        moved = (
            "; where the drive stands at events is no part of them: sections at whole periods may"
            " lie on one"
        )
        yield (
            "there is no rotation number: the sections lie on no closed curve"
            + (moved if events and moves_in_time(scene) else "")
        )
    if "flatness" in found and sections < FEWEST_FOR_SPECTRUM:
        yield f"a spectrum needs {FEWEST_FOR_SPECTRUM} sections, there are {sections}"


def _limits_of_exponent(scene: Scene, found: Mapping[str, float], periods: int) -> Iterator[str]:
    exponent, error = (found.get(name, math.nan) for name in ("lyapunov", "lyapunov_error"))
    if "lyapunov" not in found:
        if found.get("verdict") == UNDECIDED:
            yield "add the indicator 'lyapunov'"
    elif math.isnan(exponent):
        obstacle = tangent_obstacle(scene) or (
            "The tangent grew beyond all bounds."
            if periods
            else "It needs a whole period, and the recorded sections lie within one."
        )
        yield f"there is no exponent: {obstacle[0].lower()}{obstacle[1:].rstrip('.')}"
    elif math.isinf(exponent):
        yield "the tangent vanished: it shrank by more than 1e290 within a period"
    elif math.isinf(error):
        yield "the error of the exponent is not known: it needs three recorded periods"
