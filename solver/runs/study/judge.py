"""The verdict on a point: its exponent behind the record in smaller steps, and all indicators."""

from dataclasses import replace

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.point import PointEnd
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.nonlinear.lyapunov import undecided
from jointplay.solver.nonlinear.verdict import RESTS
from jointplay.solver.nonlinear.whole_turns import unwound
from jointplay.solver.runs.lasting_contacts import lasting_contacts
from jointplay.solver.runs.study.cycles import cycle_of
from jointplay.solver.runs.study.finer import go_on_finer, go_on_for, go_on_longer
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
from jointplay.solver.runs.study.verdict_limits import limits
from jointplay.solver.scene.periods import in_step


def looks_again(study: Study, bundle: Bundle, lane: int, run: PointRun) -> bool:
    """Let a point whose exponent is wanted go on in smaller steps. Returns whether it does."""
    if run.ended is None or run.ended.code or not study.carries_exponents:
        return False
    scene, period = study.point_scene(run.point), float(study.period[run.point])
    run.finer_from = go_on_finer(bundle, lane, scene, study.tolerance, period, study.record)
    return True


def looks_longer(study: Study, bundle: Bundle, lane: int, run: PointRun) -> bool:
    """Let the stretch in smaller steps go on while it settles nothing. Returns whether it does."""
    scene, period = study.point_scene(run.point), float(study.period[run.point])
    if _forgets_late_contacts(study, bundle, lane, run):
        run.finer_from = go_on_for(bundle, lane, scene, period, study.record)
        return True
    if not open_still(study, run):
        return False
    return go_on_longer(bundle, lane, scene, run.finer_from, period, study.record)


def _forgets_late_contacts(study: Study, bundle: Bundle, lane: int, run: PointRun) -> bool:
    """Drop the growth so far if a contact that began in the record has lasted ever since.

    The derivative of its impact rate never dies, and the exponent would be 0: as of contacts that
    last throughout, the tangent forgets it (`tangent.forget_latched`), and grows with the motion
    that has settled. Returns whether it has forgotten one.
    """
    at, period = bundle.lane(lane), float(study.period[run.point])
    onset, latched = at["onset_time"], at["tangent_impact_rate"] != 0.0
    since = run.finer_from * period
    late = latched & (at["mode"] > 0.0) & (run.settled * period < onset) & (onset <= since)
    if not late.any():
        return False
    at["tangent_impact_rate"] = 0.0
    run.growth, run.finer = [], []
    scene = study.point_scene(run.point)
    run.lasting = lasting_contacts(bundle, lane, scene, since, "from the record on")
    run.lasting += "; the exponent is that behind the record"
    return True


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
    moments = np.concatenate([np.zeros(0), *run.moments])
    apart = float(np.diff(moments).mean()) if len(moments) > 1 else period
    scene, coordinates = study.point_scene(run.point), len(kernel.coordinates)
    measured = bool(kernel.pairs) or scene.length is not None
    sections = Sections(states, scales, angles, coordinates, apart, measured)
    compared = study.compares_cycles or study.starts > 1
    drives = in_step(scene, period)
    found, verdict = indicators_of(
        study.indicators,
        sections,
        *growths,
        period,
        run.settled,
        compared=compared,
        drives=drives,
    )
    if run.rest:
        states, verdict = np.stack(run.rest), RESTS
        found["verdict"] = float(verdict.code)
    if compared:
        turned = unwound(states, angles)
        cycle = cycle_of(kernel.coordinates, turned, scales, angles, verdict.period)
        run.ended = replace(run.ended, statistics={**run.ended.statistics, **cycle})
    if study.brief:
        return replace(run.ended, indicators=found)
    seen, periods = len(states[:MOST_SECTIONS]), len(growths[0])
    remarks = limits(scene, found, seen, periods, events=study.ends_with_events)
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
