"""The job document: what a client asks for, strictly checked."""

from typing import Annotated, Literal

from pydantic import Field

from solver.scene.document import Scene
from solver.scene.quantities import Name, Strict

TOLERANCES = {"standard": 1e-6}
"""Named accuracies and the tolerance each stands for."""


class PresetScene(Strict):
    """A preset mechanism with some of its declared parameters set."""

    preset: Annotated[str, Field(max_length=64)]
    parameters: Annotated[dict[Name, float | str | None], Field(max_length=64)] = {}


class Section(Strict):
    """Where Poincare sections are taken: a crank angle of the first driver past its start."""

    crank_angle: Annotated[
        float, Field(ge=0.0, lt=6.283185307179586, json_schema_extra={"unit": "rad"})
    ] = 0.0


class SimulateJob(Strict):
    """One trajectory from the scene's start."""

    kind: Literal["simulate"]
    scene: PresetScene | Scene
    duration: Annotated[
        float,
        Field(ge=1e-9, le=1e12, description="simulated time", json_schema_extra={"unit": "s"}),
    ]
    tolerance: Annotated[
        float | None,
        Field(
            ge=1e-13,
            le=1e-5,
            description="local error per step, relative to the scene's own scales",
            json_schema_extra={"unit": "1"},
        ),
    ] = None
    accuracy: Annotated[
        Literal["standard"] | None, Field(description="a named tolerance: standard is 1e-6")
    ] = None
    output_step: Annotated[
        float | None,
        Field(
            ge=1e-15,
            description="time between samples; default duration/2000",
            json_schema_extra={"unit": "s"},
        ),
    ] = None
    channels: Annotated[
        list[Annotated[str, Field(min_length=1, max_length=80)]],
        Field(min_length=1, max_length=1024, description="names or globs"),
    ] = ["*"]
    formulation: Annotated[
        Literal["reduced", "lagrange"],
        Field(
            description=(
                "reduced: joint coordinates over the spanning tree; lagrange: absolute coordinates,"
                " multipliers and Baumgarte stabilisation"
            )
        ),
    ] = "reduced"
    section: Section = Section()
    label: Annotated[str, Field(max_length=200)] = ""
