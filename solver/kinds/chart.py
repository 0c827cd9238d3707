"""The kind ``chart``: which motion there is over two parameters, point by point."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds.attractors import check_distinguished
from jointplay.solver.kinds.idle_fields import check_idle
from jointplay.solver.kinds.map import AlongStart
from jointplay.solver.kinds.motion_map import MotionMap, MotionMapJob
from jointplay.solver.kinds.perturbed import Seed, check_spread, spread_up_to
from jointplay.solver.quantities.units import quantity
from jointplay.solver.runs.starts import Perturbation
from jointplay.solver.runs.study.plan import Study


class ChartJob(MotionMapJob):
    """A map over two parameters: what each point's motion is, and what is asked of it beside."""

    kind: Literal["chart"]
    continuation: Annotated[
        Literal["none", "forward", "backward"],
        Field(
            description=(
                "none: every point starts by the scene's start rule; forward, backward: from the"
                " last state of its neighbour along x, and the first of each row as the scene says"
            )
        ),
    ] = "none"
    starts: Annotated[
        int,
        quantity(
            "1",
            ge=1,
            le=64,
            description=(
                "starts that each point is computed from: the scene's, and perturbed ones; how many"
                " different attractors they end on is a quantity of the map"
            ),
        ),
    ] = 1
    spread: Annotated[float, spread_up_to(10.0)] = 0.5
    seed: Seed = 0


class Chart(MotionMap[ChartJob]):
    """A map of motions."""

    document = ChartJob
    results: ClassVar = ("points", "chart", "figures", "zarr")

    def admit(self, job: ChartJob) -> Study:
        """Check and fill in; see `Kind.admit`."""
        if job.continuation != "none" and isinstance(job.along, AlongStart):
            sentence = (
                "A point that starts from its neighbour has no start of its own; let a parameter"
                " vary along x, or leave out 'continuation'."
            )
            raise InvalidInput.at("/along/start", sentence)
        if job.refine and job.continuation != "none":
            sentence = (
                "Each point starts from its neighbour, so none can be left out; drop 'refine'."
            )
            raise InvalidInput.at("/refine", sentence)
        if job.starts > 1:
            if job.continuation != "none":
                sentence = "A point starts from its neighbour or from several starts; choose one."
                raise InvalidInput.at("/starts", sentence)
            check_distinguished(job, "Starts lie apart in")
            check_spread(job.spread)
        else:
            check_idle(job, "several 'starts'", "spread", "seed")
        return super().admit(job)

    def continuation(self, job: ChartJob) -> str:
        """Return in which direction a point starts from its neighbour along x."""
        return job.continuation

    def perturbation(self, job: ChartJob) -> Perturbation | None:
        """Return how several starts of a point lie apart."""
        return Perturbation(job.spread, job.seed) if job.starts > 1 else None

    def starts(self, job: ChartJob) -> int:
        """Return from how many starts each point is computed."""
        return job.starts
