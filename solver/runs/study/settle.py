"""The time until a point settles, in legs of some periods; then the record begins."""

from jointplay.solver.kernels.loop.runs import SECTIONS, SectionKind
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.study.point_run import PointRun
from jointplay.solver.runs.study.problem import ENDLESS, WINDOW, most_settling, scales_of


def goes_on(study: Study, bundle: Bundle, lane: int, run: PointRun) -> bool:
    """Give a lane at the end of a leg the next one. Returns whether there was one."""
    if run.settled >= 0:
        return False
    point = run.point
    scene = study.point_scene(point)
    period = float(study.period[point])
    most = most_settling(study, point)
    scales, angles = scales_of(study, bundle.kernel, point)
    if run.reached < most and not run.has_settled(scales, angles, most):
        run.reached = min(run.reached + WINDOW, most)
        bundle.extend(lane, scene, run.reached * period, ENDLESS)
        return True
    run.settled = run.reached
    if study.carries_exponents:
        bundle.lane(lane)["tangent_impact_rate"] = 0.0  # as `tangent.forget_latched` does
    run.seen = []
    left = float(study.duration[point] - study.settle[point])
    coming = bundle.lane(lane).run["next"]
    if bundle.lane(lane).run["section_kind"] == SectionKind.CRANK:
        # at a crank angle that of the last period left out is still to come
        coming[SECTIONS] = run.settled + 1
    bundle.extend(lane, scene, run.settled * period + left, int(coming[SECTIONS]) + study.record)
    return True
