"""``/v1/jobs/{id}/chart`` and ``/tiles``: a chart's axes, values, points and pictures."""

import math
from typing import Annotated, cast

import numpy as np
from fastapi import APIRouter, Path, Query, Response
from pydantic import BaseModel, ConfigDict, Field

from jointplay.records.channel import Channel
from jointplay.records.coarse_to_fine import TILE
from jointplay.records.inherited import inheriting
from jointplay.records.motion import LABELS
from jointplay.records.point import PointStatus, has_ended
from jointplay.service.charts import colouring, grids, schemas
from jointplay.service.fields import BINARY
from jointplay.service.problems import RequestRefused, kinds, problems
from jointplay.service.results.queries import MOST_VALUES
from jointplay.service.results.stores import ResultsOfThePath, StudyOfThePath
from jointplay.service.results.streaming import as_json
from jointplay.service.studies.answers import axes
from jointplay.service.studies.schemas import Status
from jointplay.solver.nonlinear.grounds import grounds
from jointplay.storage.studies.reader import StudyReader

PNG = "image/png"
_SHARE = 2.0
"""Per cent of the values beyond each end of the colours."""
_KEPT = "private, max-age=3600"
"""A tile of as many points that had ended as were asked for never changes."""

router = APIRouter(
    prefix="/v1/jobs/{job_id}", tags=["studies"], responses=problems(*kinds.OF_RESULTS)
)


class CellQuery(BaseModel):
    """A point by its indices."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    column: int = Field(ge=0, description="Index along x.")
    row: int = Field(ge=0, description="Index along y.")


class RectangleQuery(BaseModel):
    """A quantity in a rectangle of points."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    quantity: str = Field(max_length=200)
    x_start: int = Field(default=0, ge=0, description="First index along x.")
    x_stop: int | None = Field(default=None, ge=1, description="Index before which to end.")
    y_start: int = Field(default=0, ge=0, description="First index along y.")
    y_stop: int | None = Field(default=None, ge=1, description="Index before which to end.")
    every: int = Field(
        default=1, ge=1, le=4096, description="Points along each side of a cell; see tiles."
    )


class TileQuery(BaseModel):
    """Colours of a tile, and which state of the chart it is of."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False, frozen=True)

    low: float | None = Field(default=None, description="Value of the darkest colour.")
    high: float | None = Field(default=None, description="Value of the lightest colour.")
    ended: int | None = Field(
        default=None, ge=0, description="As `ended` of the chart: tiles of one state are kept."
    )

    def checked(self) -> tuple[float | None, float | None]:
        """Return both values, or refuse them where the darkest colour has the larger one."""
        if self.low is not None and self.high is not None and self.low > self.high:
            sentence = f"high ({self.high:g}) is below low ({self.low:g}); swap them."
            raise RequestRefused.of_parameter("high", sentence)
        return self.low, self.high


@router.get("/chart", response_model=schemas.Chart)
def show_chart(study: StudyOfThePath) -> Response:
    """Return axes and quantities of a chart, also while it is computed."""
    count, of = int(has_ended(study.status).sum()), axes(study)
    return as_json(
        schemas.Chart.model_construct(
            complete=study.complete,
            points=study.points,
            ended=count,
            inherited=inheriting(study),
            x=of["x"],
            y=of["y"],
            levels=_levels(study.shape),
            quantities=[_quantity(study, one) for one in grids.quantities(study).values()],
        )
    )


@router.get("/chart/point", response_model=schemas.ChartPoint)
def show_point(results: ResultsOfThePath, query: Annotated[CellQuery, Query()]) -> Response:
    """Return everything that is known of one point."""
    results.insist("chart")
    study = results.study()
    height, width = study.shape
    for name, index, size in (("column", query.column, width), ("row", query.row, height)):
        if index >= size:
            sentence = f"{name} is {index}; the chart has {size} of them, counted from 0."
            raise RequestRefused.of_parameter(name, sentence)
    cell = query.row * width + query.column
    point = int(np.flatnonzero(study.layout.order == cell)[0])
    failure = study.failures.get(point)
    numbers = {name: float(values[point]) for name, values in study.indicators.items()}
    found = {}
    for one in grids.quantities(study).values():
        value = float(grids.column(study, one.name)[point])
        label = grids.names_of(study, one.name)(int(value)) if one.name in LABELS else None
        found[one.name] = schemas.PointQuantity.of(one, value=value, label=label)
    return as_json(
        schemas.ChartPoint.model_construct(
            status=cast("Status", PointStatus(study.status[point]).name),
            detail=failure.detail if failure else grounds(numbers),
            quantities=found,
        )
    )


@router.get("/chart/values", response_model=schemas.Rectangle)
def show_values(results: ResultsOfThePath, query: Annotated[RectangleQuery, Query()]) -> Response:
    """Return a quantity in a rectangle; of larger cells as the tiles have it."""
    results.insist("chart")
    study = results.study()
    found = _known(study, query.quantity)
    height, width = study.shape
    x, y = (
        range(start // query.every, -(-min(stop or size, size) // query.every))
        for start, stop, size in (
            (query.x_start, query.x_stop, width),
            (query.y_start, query.y_stop, height),
        )
    )
    for name, cells in (("x_start", x), ("y_start", y)):
        if not cells:
            sentence = f"The rectangle is empty; {name} is its first index, below its stop."
            raise RequestRefused.of_parameter(name, sentence)
    if len(x) * len(y) > MOST_VALUES:
        sentence = (
            f"These are {len(x) * len(y)} cells; an answer carries at most {MOST_VALUES}. Ask for a"
            " smaller rectangle, or for larger cells with `every`."
        )
        raise RequestRefused.of_parameter(
            "every", sentence, kinds.RESPONSE_TOO_LARGE, remedy="Choose larger cells."
        )
    count = int(has_ended(study.status).sum())
    grid = grids.GRIDS.of(results, count, query.quantity, query.every)
    part = grid.values[y.start : y.stop, x.start : x.stop]
    return as_json(
        schemas.Rectangle.model_construct(
            unit=found.unit,
            columns=[query.every * one for one in x],
            rows=[query.every * one for one in y],
            values=list(part.astype(np.float64)),
        )
    )


@router.get(
    "/tiles/{quantity}/{z}/{x}/{y}.png",
    response_class=Response,
    responses={200: {"content": {PNG: BINARY}}},
)
def show_tile(
    results: ResultsOfThePath,
    quantity: Annotated[str, Path(max_length=200)],
    z: Annotated[int, Path(ge=0, le=32, description="Level; 0 has the whole chart in one tile.")],
    x: Annotated[int, Path(ge=0, description="Index of the tile from the left.")],
    y: Annotated[int, Path(ge=0, description="Index of the tile from the bottom.")],
    query: Annotated[TileQuery, Query()],
) -> Response:
    """Return a picture of 256 x 256 cells of a chart; what is not known is clear."""
    results.insist("chart")
    lowest, highest = query.checked()
    state = _state(results, quantity, query.ended)
    labels = quantity in LABELS
    finest = grids.GRIDS.of(results, state, quantity, 1)
    levels = _levels(finest.values.shape)
    if z >= levels:
        sentence = f"The chart has levels 0 to {levels - 1}."
        raise RequestRefused.of_parameter("z", sentence)
    stride = 1 << (levels - 1 - z)
    grid = finest if stride == 1 else grids.GRIDS.of(results, state, quantity, stride)
    values = grid.values
    part = values[y * TILE : (y + 1) * TILE, x * TILE : (x + 1) * TILE]
    if not part.size:
        raise RequestRefused.of_parameter("x", f"Level {z} has no tile {x}, {y}.")
    if labels:
        picture = colouring.picture_of_labels(part.astype(np.uint8), grids.colours_of(quantity))
    else:
        known = values[np.isfinite(values)]
        low = lowest if lowest is not None else float(known.min(initial=np.inf))
        high = highest if highest is not None else float(known.max(initial=-np.inf))
        picture = colouring.picture_of_values(part.astype(np.float64), low, high)
    kept = _KEPT if query.ended == grid.ended else "no-cache"
    return Response(picture, media_type=PNG, headers={"Cache-Control": kept})


def _state(results: ResultsOfThePath, quantity: str, asked: int | None) -> int:
    """Return how many points have ended in the state of a chart that a tile shows; default: now's.

    A quantity that there is not is refused, and so is a state to come: what is kept as that state
    would be shown when the chart gets there.
    """
    if asked is not None and grids.GRIDS.has(results.job.id, asked, quantity):
        return asked
    study = results.study()
    _known(study, quantity)
    ended = int(has_ended(study.status).sum())
    if asked is not None and asked > ended:
        sentence = f"Of the chart {ended} points have ended, and not {asked}."
        raise RequestRefused.of_parameter("ended", sentence)
    return ended if asked is None else asked


def _known(study: StudyReader, quantity: str) -> Channel:
    found = grids.quantities(study)
    if quantity not in found:
        sentence = f"There is no quantity {quantity!r}; there are {', '.join(found)}."
        raise RequestRefused.of_parameter("quantity", sentence)
    return found[quantity]


def _levels(shape: tuple[int, ...]) -> int:
    return 1 + max(0, math.ceil(math.log2(max(shape) / TILE)))


def _quantity(study: StudyReader, one: Channel) -> schemas.Quantity:
    values = grids.column(study, one.name)
    labels, low, high = None, None, None
    if one.name in LABELS:
        name_of, colour_of = grids.names_of(study, one.name), grids.colours_of(one.name)
        labels = [
            schemas.Label.model_construct(
                code=code, name=name_of(code), colour=colour_of(code), points=points
            )
            for code, points in grids.counted(values.astype(np.uint8)).items()
        ]
    else:
        known = values[np.isfinite(values)]
        if len(known):
            low, high = (float(one) for one in np.percentile(known, (_SHARE, 100.0 - _SHARE)))
    shades = [] if labels is not None else list(colouring.SHADES)
    return schemas.Quantity.of(one, name=one.name, labels=labels, low=low, high=high, shades=shades)
