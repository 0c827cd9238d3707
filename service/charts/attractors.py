"""``/v1/jobs/{id}/attractors``: the attractors that the points of a map end on."""

from fastapi import APIRouter, Response

from jointplay.records.attractor_table import attractor_table
from jointplay.service.charts import schemas
from jointplay.service.problems import kinds, problems
from jointplay.service.results.stores import StudyOfThePath
from jointplay.service.results.streaming import as_json

router = APIRouter(
    prefix="/v1/jobs/{job_id}", tags=["studies"], responses=problems(*kinds.OF_RESULTS)
)


@router.get("/attractors", response_model=schemas.Attractors)
def show_attractors(study: StudyOfThePath) -> Response:
    """Return the attractors of a map, how often they are reached, and how rough the boundary is."""
    return as_json(schemas.Attractors.model_validate(attractor_table(study)))
