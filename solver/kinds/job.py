"""Fields that the documents of all kinds of jobs share."""

from typing import Annotated, Any, Literal

from pydantic import Field

from jointplay.solver.integrators import AUTO, COARSE, METHODS, STIFF
from jointplay.solver.quantities.registry import NameIn
from jointplay.solver.quantities.units import Name, Strict, quantity
from jointplay.solver.runs.admission import STANDARD_TOLERANCE
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.unions import discriminated_by, form, has

Method = Annotated[str, NameIn(METHODS, "auto")]
Accuracy = Literal["draft", "standard", "fine", "reference"]

ACCURACIES: dict[Accuracy, tuple[str, float]] = {
    "draft": (COARSE.name, 3e-4),
    "standard": ("auto", STANDARD_TOLERANCE),
    "fine": ("auto", 1e-8),
    "reference": ("auto", 1e-11),
}
"""Method and tolerance of the named accuracies, chosen from work-precision measurements."""

ChannelPattern = Annotated[str, Field(min_length=1, max_length=80)]
ChannelChoice = Annotated[
    list[ChannelPattern], Field(min_length=1, max_length=4096, description="names or globs")
]
Observables = Annotated[
    ChannelChoice | None,
    Field(
        description=(
            "channels kept at sections, names or globs; default: the generalised coordinates"
            " and the eccentricities, with their rates"
        )
    ),
]
Energies = Annotated[
    bool,
    Field(
        description=(
            "whether each point has its works and what its energy ledger lacks; they take a tenth"
            " of its time"
        )
    ),
]


class PresetScene(Strict):
    """A preset mechanism with some of its declared parameters set."""

    preset: Annotated[str, Field(max_length=64)]
    parameters: Annotated[dict[Name, float | str | None], Field(max_length=64)] = {}


def _form_of_scene(value: Any) -> str | None:
    if has(value, "preset"):
        return "preset"
    if any(has(value, field) for field in Scene.model_fields if field != "parameters"):
        return "scene"
    return "preset" if isinstance(value, dict) and value else None


SceneChoice = Annotated[
    Annotated[PresetScene, form("preset")] | Annotated[Scene, form("scene")],
    discriminated_by(
        _form_of_scene, "'scene' must be a scene document, or an object with a 'preset'"
    ),
    Field(description="a preset with parameters set, or a whole scene document"),
]


class MechanismJob(Strict):
    """Fields of every kind: the mechanism, and the form of its equations."""

    kind: str
    scene: SceneChoice
    formulation: Annotated[
        Literal["reduced", "lagrange"],
        Field(
            description=(
                "reduced: joint coordinates over the spanning tree; lagrange: absolute coordinates,"
                " multipliers and Baumgarte stabilisation"
            )
        ),
    ] = "reduced"
    label: Annotated[str, Field(max_length=200, description="a name of your own for the job")] = ""

    @property
    def named_channels(self) -> list[str]:
        """Channels that the job names, patterns among them."""
        return []

    @property
    def varied_starts(self) -> list[str]:
        """Numbers of the start that vary from point to point, as JSON pointers into the scene."""
        return []


class Job(MechanismJob):
    """Fields of every kind but the one that tries every method: how the motion is computed."""

    tolerance: Annotated[
        float | None,
        quantity(
            "1",
            ge=1e-13,
            le=1e-2,
            description="local error per step, relative to the scene's own scales",
        ),
    ] = None
    accuracy: Annotated[
        Accuracy | None,
        Field(
            description=(
                "or a named method and tolerance; default: standard, 1e-6, with indicators that"
                " compare sections 1e-9"
            )
        ),
    ] = None
    method: Annotated[
        Method,
        Field(
            description=(
                f"auto: {AUTO.name}, or {COARSE.name} at tolerances too large for it, or"
                f" {STIFF.name} where the run turns out to be stiff; rodas: implicit; rk4: a fixed"
                " step, without error control or located onsets"
            )
        ),
    ] = "auto"
    step: Annotated[
        float | None,
        quantity("s", ge=1e-12, le=1e3, description="of the method rk4, its fixed step"),
    ] = None

    @property
    def usual_tolerance(self) -> float:
        """Tolerance where neither one nor a named accuracy is given."""
        return ACCURACIES["standard"][1]
