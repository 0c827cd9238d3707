"""Grounds of a verdict, from the numbers that are kept of a point."""

import math
from collections.abc import Mapping

from jointplay.solver.nonlinear.decision import decide
from jointplay.solver.nonlinear.estimate import UNKNOWN, Estimate
from jointplay.solver.nonlinear.verdict import EQUILIBRIUM, QUASI_PERIODIC, RESTS
from jointplay.solver.scene.periods import InStep


def grounds(found: Mapping[str, float]) -> str:
    """Return the reason of a verdict from the numbers that are kept of a point; empty: none is.

    Its exponent in far smaller steps and its sections are not kept, and errors are those in all:
    where these numbers alone would not give the verdict, that is said.
    """
    if not math.isfinite(found.get("verdict", math.nan)):
        return ""
    if found["verdict"] == EQUILIBRIUM:
        return RESTS.reason
    period = found.get("period", math.nan)
    recurrence = int(period) if math.isfinite(period) else None
    lyapunov, zero_one, rotation = (
        _kept(found, name) for name in ("lyapunov", "zero_one", "rotation")
    )
    if "period" not in found and lyapunov is not None and lyapunov.exceeds(0.0):
        recurrence = 0  # looked for, and not kept, by earlier versions
    if rotation is None and "rotation" in found:
        rotation = UNKNOWN
    verdict = decide(lyapunov, zero_one, recurrence, rotation)
    if verdict.code != found["verdict"] == QUASI_PERIODIC:
        beside = InStep(back=True, others=1)
        verdict = decide(lyapunov, zero_one, recurrence, rotation, drives=beside)
    if verdict.code == found["verdict"]:
        return verdict.reason
    seen = "" if lyapunov is None else f": it is {lyapunov} 1/s"
    return f"by the errors of the record, its sections, or the exponent in far smaller steps{seen}"


def _kept(found: Mapping[str, float], name: str) -> Estimate | None:
    value, error = found.get(name, math.nan), found.get(f"{name}_error", math.nan)
    return Estimate(value, error) if math.isfinite(value) and error >= 0.0 else None
