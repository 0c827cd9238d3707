"""``/v1/estimates``: what a job will cost, before anything is queued."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Annotated

from fastapi import APIRouter
from pydantic import BaseModel, Field

from jointplay.service.access import CallerDependency
from jointplay.service.body import JobBody
from jointplay.service.checking import CheckJob
from jointplay.service.dependencies import (
    CatalogueDependency,
    CheckerDependency,
    of_the_application,
)
from jointplay.service.fields import in_unit
from jointplay.service.jobs.submission import REQUEST_BODY
from jointplay.service.prober import Prober
from jointplay.service.problems import kinds, problems
from jointplay.storage.catalogue.at_work import Devices

router = APIRouter(prefix="/v1/estimates", tags=["jobs"])


class Estimate(BaseModel):
    """Cost of a job on the machine of the service."""

    seconds: float = in_unit(
        "s", "Computing time of one core; compiling is not in it, nor waiting in the queue."
    )
    compilation: float = in_unit(
        "s",
        "What compiling the equations took of one core, 0 where they were compiled before; the code"
        " is kept, so that workers on this machine need not compile it again.",
    )
    device_seconds: float | None = in_unit(
        "s",
        "The same of the graphics processors of all workers that are alive together, by how much"
        " faster than a core of this machine they were in their trials; preparing and judging"
        " points, a few milliseconds each, is not in it. Null: there are none, or they do not"
        " compute such a job.",
    )
    steps: int = in_unit("1", "Accepted steps of the solver.")
    bytes: int = in_unit("B", "What the results take on the disk.")
    points: int = Field(description="Points of a study; 1 of a simulation.")
    blocks: int = Field(description="Parts that workers can compute at the same time.")
    exact: bool = Field(
        description="Whether the whole job was computed for it, and not only its beginning."
    )
    at_most: bool = Field(
        description="Whether it may cost less: a map that is refined computes only those points"
        " between which the motion changes."
    )
    failure: str | None = Field(description="Why the job, or a point of it, will end early.")
    cached: bool = Field(
        description="Whether an identical job is there, so that a submission costs nothing."
    )


@router.post(
    "",
    openapi_extra={"requestBody": REQUEST_BODY},
    responses=problems(*kinds.OF_A_BODY, kinds.INVALID_REQUEST),
)
def estimate_job(
    body: JobBody,
    catalogue: CatalogueDependency,
    checker: CheckerDependency,
    caller: CallerDependency,
    prober: Annotated[Prober, of_the_application("prober")],
) -> Estimate:
    """Say what a job will cost, and queue nothing.

    The document is checked as POST /v1/jobs checks it.  Then half a second of the job is computed
    on this machine; the pace at the end of it is taken for the rest.
    """
    found = checker.check(CheckJob(), body)
    own = replace(found.job, owner=caller.owner)
    cached = found.reuse and catalogue.identical(own) is not None
    refined = bool(own.spec.get("refine"))
    devices = catalogue.devices()
    cost = prober.cost_of(own.spec, on_devices=bool(devices))
    steps = cost.pop("trial_steps")
    seconds = None if steps is None else on_devices(steps, cost["points"], devices)
    return Estimate(**cost, device_seconds=seconds, at_most=refined, cached=cached)


def on_devices(steps: float, points: int, devices: Mapping[str, Devices]) -> float:
    """Return how long devices take together for so many steps of the mechanism of their trials [s].

    Points that do not fill the lanes take as long as if they did.
    """
    rate, lanes = (sum(getattr(one, of) for one in devices.values()) for of in ("rate", "lanes"))
    return float(steps / (rate * min(points / lanes, 1.0)))
