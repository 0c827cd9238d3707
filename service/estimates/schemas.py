"""Estimates as the API shows them."""

from pydantic import BaseModel, Field


class Estimate(BaseModel):
    """Cost of a job on the machine of the service."""

    seconds: float = Field(
        description="Computing time of one core; compiling is not in it, nor waiting in the queue.",
        json_schema_extra={"unit": "s"},
    )
    steps: int = Field(description="Accepted steps of the solver.", json_schema_extra={"unit": "1"})
    bytes: int = Field(
        description="What the results take on the disk.", json_schema_extra={"unit": "B"}
    )
    points: int = Field(description="Points of a study; 1 of a simulation.")
    blocks: int = Field(description="Parts that workers can compute at the same time.")
    exact: bool = Field(
        description="Whether the whole job was computed for it, and not only its beginning."
    )
    failure: str | None = Field(description="Why the job, or a point of it, will end early.")
    cached: bool = Field(
        description="Whether an identical job is there, so that a submission costs nothing."
    )
