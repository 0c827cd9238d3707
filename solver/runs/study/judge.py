"""The verdict on a point: its exponent behind the record in smaller steps, and all indicators."""

from dataclasses import replace

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.point import PointEnd
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.loop.bundle import Bundle
from jointplay.solver.nonlinear.lyapunov import undecided
from jointplay.solver.nonlinear.verdict import RESTS
from jointplay.solver.nonlinear.whole_turns import unwound
from jointplay.solver.runs.lasting_contacts import lasting_contacts
from jointplay.solver.runs.study.cycles import cycle_of
from jointplay.solver.runs.study.finer import go_on_finer, go_on_longer
from jointplay.solver.runs.study.grounds import limits
from jointplay.solver.runs.study.indicators import (
    MOST_SECTIONS,
    Sections,
    exponents,
    growth_by_period,
    indicators_of,
)
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.study.point_run import PointRun
from jointplay.solver.runs.study.problem import scales_of


def looks_again(study: Study, bundle: Bundle, lane: int, run: PointRun) -> bool:
    """Let a point whose exponent is wanted go on in smaller steps. Returns whether it does."""
    if run.ended is None or run.ended.code or not study.carries_exponents:
        return False
    scene, period = study.point_scene(run.point), float(study.period[run.point])
    _forget_late_contacts(study, bundle, lane, run)
    run.finer_from = go_on_finer(bundle, lane, scene, study.tolerance, period, study.record)
    return True


def _forget_late_contacts(study: Study, bundle: Bundle, lane: int, run: PointRun) -> None:
    """Leave out the record's growth if a contact that began in it has lasted for most of it.

    The derivative of its impact rate never dies, and the exponent would be 0: as of contacts that
    last throughout, the tangent forgets it (`tangent.forget_latched`), and behind the record grows
    with the motion that has settled.
    """
    at, begun = bundle.lane(lane), run.settled * float(study.period[run.point])
    since = 0.5 * (begun + at.time)
    onset = at["onset_time"]
    late = (at["mode"] > 0.0) & (begun < onset) & (onset < since) & (at["impact_floor"] > 0.0)
    if not late.any():
        return
    at["tangent_impact_rate"] = 0.0
    run.growth = []
    said = lasting_contacts(bundle, lane, study.point_scene(run.point), since)
    run.lasting = (
        f"the exponent is that behind the record, in whose first half a contact began; {said}"
    )


def looks_longer(study: Study, bundle: Bundle, lane: int, run: PointRun) -> bool:
    """Lengthen the stretch in smaller steps while it settles nothing. Returns whether it does."""
    if not open_still(study, run):
        return False
    scene, period = study.point_scene(run.point), float(study.period[run.point])
    return go_on_longer(bundle, lane, scene, run.finer_from, period, study.record)


def open_still(study: Study, run: PointRun) -> bool:
    """Return whether the stretch in smaller steps settles nothing so far."""
    period = float(study.period[run.point])
    return undecided(*exponents(*_growths(study, run), period, run.settled))


def judged(study: Study, kernel: Kernel, run: PointRun) -> PointEnd:
    """Return a point's end with its indicators, for which now all is there."""
    assert run.ended is not None  # noqa: S101  (narrows the type)
    if run.ended.code or not study.indicators:
        return run.ended
    states = np.concatenate(run.seen) if run.seen else np.zeros((0, kernel.states))
    scales, angles = scales_of(study, kernel, run.point)
    period, growths = float(study.period[run.point]), _growths(study, run)
    sections = Sections(states, scales, angles, len(kernel.coordinates))
    found, verdict = indicators_of(study.indicators, sections, *growths, period, run.settled)
    if run.rest:
        states, verdict = np.stack(run.rest), RESTS
        found["verdict"] = float(verdict.code)
    if study.compares_cycles or study.starts > 1:
        turned = unwound(states, angles)
        cycle = cycle_of(kernel.coordinates, turned, scales, angles, verdict.period)
        run.ended = replace(run.ended, statistics={**run.ended.statistics, **cycle})
    if study.brief:
        return replace(run.ended, indicators=found)
    seen, periods = len(states[:MOST_SECTIONS]), len(growths[0])
    remarks = limits(study.point_scene(run.point), found, seen, periods)
    reason = "; ".join(filter(None, [verdict.reason, run.lasting, *remarks]))
    return replace(run.ended, indicators=found, reason=reason)


def _growths(study: Study, run: PointRun) -> tuple[Floats, Floats]:
    """Return logarithms of the tangent's growth by period: in the record, and behind it.

    Where the record's is left out, that behind it stands for both.
    """
    period = float(study.period[run.point])
    growth, finer = (
        growth_by_period(np.concatenate([np.zeros((0, 2)), *rows]), period, since)
        for rows, since in ((run.growth, run.settled), (run.finer, run.finer_from))
    )
    return (growth if run.growth else finer), finer
