"""Job documents of studies for tests: small ones of the press, one of each kind."""

from typing import Any

from jointplay.solver.kinds import admit
from jointplay.solver.runs.study.plan import Study

PRESS: dict[str, Any] = {"preset": "seven-bar-press", "parameters": {"stiffness": 5e9}}
BIFURCATION: dict[str, Any] = {
    "kind": "bifurcation",
    "scene": PRESS,
    "parameter": "clearance",
    "values": [1e-4, 3e-4, 5e-4],
}
SWEEP: dict[str, Any] = {
    "kind": "sweep",
    "scene": PRESS,
    "grid": {"clearance": [1e-4, 3e-4], "friction": {"from": 0.0, "to": 0.1, "count": 3}},
    "periods": 2.0,
}
POINCARE: dict[str, Any] = {"kind": "poincare", "scene": PRESS}
ENSEMBLE: dict[str, Any] = {"kind": "ensemble", "scene": PRESS, "members": 20}
ACCURACY_STUDY: dict[str, Any] = {"kind": "accuracy-study", "scene": PRESS}
EVERY = (BIFURCATION, SWEEP, POINCARE, ENSEMBLE, ACCURACY_STUDY)
STUDIES = {job["kind"]: job for job in EVERY}


def study(job: dict[str, Any], **changes: Any) -> Study:
    """Return the study of a job with some fields changed."""
    found = admit({**job, **changes})
    assert isinstance(found, Study)
    return found
