"""Periodic, quasi-periodic, chaotic, at rest, or undecided: what the indicators say together.

chaotic : the exponent exceeds zero by more than three errors, in smaller steps too, nothing recurs,
    and K > 0.9. Where there is no K, an exponent will do that does not drift, if it is known that
    nothing recurs, and sections leave no orbit: neighbours of an unstable one part, too.
periodic : every p-th section is the same and the exponent is not positive. An exponent near zero
    and K > 0.9 contradict that, or that sections may recur by chance; a clearly negative exponent
    overrules both. Sections that creep say nothing of where they come to.
quasi-periodic : exponent within three errors of zero, K < 0.1, a closed curve with a rotation
    number, and no recurrence. Where what drives the mechanism does not repeat, neighbours may
    converge to such a motion: the exponent that is zero is that of the drive.
undecided : the exponent is another in smaller steps, or anything else; the reason says what is
    missing or what contradicts what, and what to try.
"""

import math

from jointplay.solver.nonlinear.estimate import Estimate
from jointplay.solver.nonlinear.lyapunov import confirmed, contradicts
from jointplay.solver.nonlinear.verdict import CHAOTIC, PERIODIC, QUASI_PERIODIC, Verdict, undecided
from jointplay.solver.nonlinear.zero_one import FEWEST_TELLING
from jointplay.solver.scene.periods import InStep

REGULAR, IRREGULAR = 0.1, 0.9
"""K of the 0-1 test below and above which it has an opinion."""
VAGUE = 0.5
"""Error of K from which on it has none."""
LOOSE = 0.01
"""Error of a rotation number, in turns, from which on the curve is not traversed steadily."""
LONGER, SMALLER, MORE = "settle for longer", "choose a smaller tolerance", "record more sections"
RECUR = "record four sections or more with the indicator 'recurrence'"
TEST = f"record {FEWEST_TELLING} sections with the indicator 'zero_one'"
"""Remedies where nothing is decided."""
BY_CHANCE, CREEPS, WITHIN = "by chance", "creeps", "within"
"""Doubts in that sections which recur do so for good."""


def decide(
    lyapunov: Estimate | None,
    zero_one: Estimate | None,
    period: int | None,
    rotation: Estimate | None = None,
    finer: Estimate | None = None,
    *,
    drives: InStep | None = None,
    leaves: bool = False,
    doubt: str = "",
) -> Verdict:
    """Return the verdict on a motion from the indicators of the whole system, as said above.

    lyapunov : largest exponent, 1/s, other than the zero along an autonomous flow. zero_one : K.
    period : by recurrence; 0 where there is none up to the longest looked for. rotation : rotation
    number; not finite where the section is no closed curve. finer : the exponent in far smaller
    steps. drives : which are in step with sections. leaves : whether sections leave an unstable
    orbit. doubt : in that they recur for good, BY_CHANCE, CREEPS or WITHIN. None: not known. An
    exponent that is not finite, and a K with an error of 0.5 or more (too few sections), are as
    good as none.

    The reason gives an exponent with the error of its record, by which it is judged, and where its
    steps are worse than that, "in all" with the error that `confirmed` gives it.
    """
    if lyapunov is not None and not math.isfinite(lyapunov.value + lyapunov.error):
        lyapunov = None
    if finer is not None and not math.isfinite(finer.value + finer.error):
        finer = None
    if zero_one is not None and not zero_one.error < VAGUE:
        zero_one = None
    if lyapunov is not None and finer is not None and contradicts(finer, lyapunov):
        return undecided(
            f"the exponent is {lyapunov} 1/s, but {finer} 1/s in far smaller steps behind the"
            " record: the steps of this tolerance are too long for it, or the motion has not"
            f" settled; {SMALLER}, or {LONGER}"
        )
    exponent = "" if lyapunov is None else f"the exponent is {_told(lyapunov, finer)}"
    if period:
        return _recurrent(lyapunov, zero_one, period, exponent, doubt)
    if lyapunov is None:
        return _without_exponent(zero_one, period)
    if lyapunov.exceeds(0.0):
        return _diverging(lyapunov, zero_one, finer, _unstable(period, leaves=leaves))
    if lyapunov.falls_below(0.0):
        if drives is not None and drives.others:
            verdict = _carried_along(exponent, zero_one, rotation, drives)
        else:
            verdict = _converging(exponent, period, repeats=drives is not None)
        return verdict
    return _neutral(exponent, zero_one, period, rotation)


def _told(lyapunov: Estimate, finer: Estimate | None) -> str:
    """Return an exponent in words; see `decide`."""
    whole = lyapunov if finer is None else confirmed(lyapunov, finer)
    if not lyapunov.error < whole.error < math.inf:
        return f"{lyapunov} 1/s"
    return f"{lyapunov} 1/s, in all {whole} 1/s"


def _recurrent(
    lyapunov: Estimate | None,
    zero_one: Estimate | None,
    period: int,
    exponent: str,
    doubt: str,
) -> Verdict:
    recurs = f"every section recurs after {period}"
    if lyapunov is not None and lyapunov.exceeds(0.0):
        return undecided(
            f"{recurs}, yet neighbours part, {exponent}: chaos in bands narrower than what counts"
            f" as the same, or an unstable orbit not yet left; {LONGER}, {SMALLER}, or start"
            " elsewhere"
        )
    fades = lyapunov is not None and lyapunov.falls_below(0.0)
    if doubt == CREEPS or (doubt and not fades):
        return undecided(f"{recurs}, but {_doubtful(doubt, exponent)}")
    if fades:
        return Verdict(PERIODIC, period, f"{recurs} and {exponent}")
    if zero_one is not None and zero_one.value > IRREGULAR:
        return undecided(
            f"{recurs}, yet the 0-1 test sees chaos, K is {zero_one}: {SMALLER} or {MORE}"
        )
    if lyapunov is None:
        return Verdict(PERIODIC, period, f"{recurs}; the exponent is not known")
    near = "close to a bifurcation, known too poorly to tell it from zero, or along the motion"
    near += " of a scene that nothing drives, where it is zero"
    return Verdict(PERIODIC, period, f"{recurs}; {exponent}, {near}")


def _doubtful(doubt: str, exponent: str) -> str:
    if doubt == CREEPS:
        return (
            "they creep, and if they go on so they leave what counts as the same: the motion has"
            " not settled, or passes where an orbit is about to appear, as intermittent chaos does;"
            f" {LONGER}, or {MORE}"
        )
    told = f"; {exponent}" if exponent else ", or add the indicator 'lyapunov'"
    if doubt == WITHIN:
        return (
            "within what counts as the same they move in no order, and do not come closer to each"
            " other: chaos or noise that is as small as that; give the scene a 'length' as small as"
            f" the motion, {SMALLER}, or {LONGER}{told}"
        )
    return (
        "for a while chaos may do so, too, where it passes an unstable orbit:"
        f" {MORE} or {LONGER}{told}"
    )


def _without_exponent(zero_one: Estimate | None, period: int | None) -> Verdict:
    seen = "" if zero_one is None else f" (K is {zero_one})"
    if period is None:
        return undecided(f"without an exponent nothing is certain{seen}")
    return undecided(
        f"no short period is seen{seen}: the motion may not have settled, or have a longer"
        f" period or none; {LONGER}, {MORE}, or add the indicator 'lyapunov'"
    )


def _unstable(period: int | None, *, leaves: bool) -> str:
    """Return why neighbours may part though nothing is chaotic; empty: there is no reason."""
    if period is None:
        return f"whether sections recur, as on an unstable orbit, is not known: {RECUR}"
    if leaves:
        return f"sections part as neighbours do, as on the way from an unstable orbit: {LONGER}"
    return ""


def _diverging(
    lyapunov: Estimate, zero_one: Estimate | None, finer: Estimate | None, unstable: str
) -> Verdict:
    parts = f"neighbours part, the exponent is {lyapunov} 1/s"
    if finer is not None and not finer.exceeds(0.0):
        return undecided(
            f"{parts}, but {finer} 1/s in far smaller steps, not different from zero: {MORE}, or"
            f" {SMALLER}"
        )
    if finer is not None:
        parts = f"neighbours part, the exponent is {_told(lyapunov, finer)}, {finer} 1/s"
        parts += " in far smaller steps"
    if zero_one is None and lyapunov.drifting:
        return undecided(
            f"{parts}, but it still drifts, and there is no 0-1 test to confirm it: {LONGER},"
            f" or {TEST}"
        )
    if zero_one is None and unstable:
        return undecided(f"{parts}, but {unstable}, or {TEST}")
    if zero_one is None:
        return Verdict(CHAOTIC, 0, f"{parts}; there is no 0-1 test to confirm it")
    if zero_one.value > IRREGULAR:
        return Verdict(CHAOTIC, 0, f"{parts}, and the 0-1 test agrees, K is {zero_one}")
    return undecided(f"{parts}, but the 0-1 test does not agree, K is {zero_one}: {MORE}")


def _neutral(
    exponent: str, zero_one: Estimate | None, period: int | None, rotation: Estimate | None
) -> Verdict:
    neutral = f"{exponent}, not different from zero"
    if zero_one is None:
        recur = f", or {RECUR}" if period is None else ""
        return undecided(
            f"{neutral}, and there is no telling 0-1 test: {SMALLER}, or {TEST}{recur}"
        )
    if zero_one.value >= REGULAR:
        return undecided(
            f"{neutral}, but the 0-1 test sees no regular motion, K is {zero_one}: {SMALLER} or"
            f" {MORE}"
        )
    if rotation is None:
        missing = "'rotation'" if period == 0 else "'rotation' or 'recurrence'"
        return undecided(
            f"{neutral}, K is {zero_one}, but whether the section is a closed curve is not known:"
            f" {LONGER}, {SMALLER}, or add the indicator {missing}"
        )
    if not math.isfinite(rotation.value):
        missing = "" if period == 0 else ", or add the indicator 'recurrence'"
        return undecided(
            f"{neutral}, K is {zero_one}, but the section is no closed curve: {LONGER}, {SMALLER}"
            f" or {MORE}{missing}"
        )
    if not rotation.error < LOOSE:
        return undecided(
            f"{neutral}, K is {zero_one}, but the rotation number is {rotation}: {MORE}"
        )
    return Verdict(
        QUASI_PERIODIC,
        0,
        f"{neutral}, K is {zero_one}, and the section is a closed curve"
        f" with rotation number {rotation}",
    )


def _converging(exponent: str, period: int | None, *, repeats: bool) -> Verdict:
    """Return the verdict where neighbours converge and nothing is seen to recur."""
    converge = f"neighbours converge, {exponent}, but"
    if period is None:
        return undecided(f"{converge} whether sections recur is not known: {RECUR}")
    none = "" if repeats else ", or none where what drives it does not repeat"
    return undecided(
        f"{converge} no short period is seen: the motion may not have settled, or have a longer"
        f" period{none}; {LONGER}, {SMALLER} or {MORE}"
    )


def _carried_along(
    exponent: str, zero_one: Estimate | None, rotation: Estimate | None, drives: InStep
) -> Verdict:
    """Return the verdict where neighbours converge to what a drive that does not repeat makes."""
    drive = f"neighbours converge, {exponent}, and what drives the motion does not repeat"
    drive += " from section to section"
    if zero_one is None or rotation is None:
        return undecided(
            f"{drive}: to see whether sections lie on a closed curve, {TEST} and 'rotation'"
        )
    if zero_one.value >= REGULAR:
        return undecided(
            f"{drive}, but the 0-1 test sees no regular motion, K is {zero_one}: {LONGER} or {MORE}"
        )
    if not math.isfinite(rotation.value):
        return undecided(
            f"{drive}, K is {zero_one}, but the section is no closed curve: {_on_a_curve(drives)}"
        )
    if not rotation.error < LOOSE:
        return undecided(f"{drive}, K is {zero_one}, but the rotation number is {rotation}: {MORE}")
    return Verdict(
        QUASI_PERIODIC,
        0,
        f"{drive}, K is {zero_one}, and the section is a closed curve"
        f" with rotation number {rotation}",
    )


def _on_a_curve(drives: InStep) -> str:
    """Return what to try where sections of drives without a common period lie on no curve."""
    if drives.back + drives.others > 2:
        return f"only two drives make one, here are more; {LONGER} or {MORE}"
    one = "" if drives.back else "take sections at the period of one of two drives, "
    return f"{one}{LONGER} or {MORE}"
