"""Layout of a study's store: many points, and for each its sections, peaks and numbers."""

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from hashlib import sha256
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Integers
from jointplay.records.channel import TIME, Channel
from jointplay.records.coarse_to_fine import order_of, over_axes
from jointplay.storage.errors import InvalidLayout
from jointplay.storage.results.layout import check_attributes, check_names

STUDY_SCHEMAS: Final = (1, 2)
"""Schema of a store whose points lie on one axis, and of one whose points are a map over two."""
_CHUNK_VALUES: Final = 16_384
"""Most values of sections that are compressed together."""
CHUNK_SECTIONS: Final = 4096
"""Most sections of one point in a chunk: what waits for its chunk is rewritten every second."""

_FEWEST_POINTS: Final = 8
_MOSTLY: Final = 0.75


@dataclass(frozen=True, eq=False)
class StudyLayout:
    """Everything that fixes a study's arrays before the first number is known.

    Parameters
    ----------
    parameters
        What differs between points; none for one point that is only perturbed.
    values
        (points, parameters), in the units of the parameters.
    observables
        What is stored at each section, beside its time.
    record
        Most sections of a point; 0 where none are taken.
    channels
        Whose extremes are kept for each point.
    blocks
        (first, count) of the contiguous points that are computed together.
    attributes
        JSON document for the root group: the filled-in job, the scene, versions, code tables.
    outputs
        Units and long names of statistics and indicators, by name, as far as they are known.
    shape
        Lengths of the axes of what has one number a point: all points, or (y, x) where they are a
        map over two parameters, of which the first varies slowest.

    Raises
    ------
    InvalidLayout
        A name that a store cannot hold or that occurs twice, blocks that leave points out, points
        that do not fill the shape, or attributes that JSON cannot carry.
    """

    parameters: tuple[Channel, ...]
    values: NDArray[np.float64]
    observables: tuple[Channel, ...]
    record: int
    channels: tuple[Channel, ...]
    blocks: tuple[tuple[int, int], ...]
    attributes: dict[str, Any] = field(default_factory=dict)
    outputs: Mapping[str, Channel] = field(default_factory=dict)
    shape: tuple[int, ...] = ()

    def __post_init__(self) -> None:
        if not self.shape:
            object.__setattr__(self, "shape", (self.points,))
        if self.values.ndim != 2 or self.values.shape[1] != len(self.parameters):
            raise InvalidLayout(
                f"values of {len(self.parameters)} parameters need as many columns, not the shape"
                f" {self.values.shape}"
            )
        # each in a group of its own: what other arrays and groups are called does not matter
        check_names(self.parameters, "parameter")
        check_names((*self.observables, TIME), "observable")
        check_names(self.channels, "channel")
        if self.record < 0 or bool(self.record) != bool(self.observables):
            raise InvalidLayout("sections are recorded of observables, and of nothing else")
        reached = 0
        for first, count in self.blocks:
            if first != reached or count < 1:
                raise InvalidLayout(f"the block after point {reached} begins at point {first}")
            reached += count
        if reached != self.points:
            raise InvalidLayout(f"the blocks hold {reached} of {self.points} points")
        if self.shape != (self.points,) and not self._is_map():
            raise InvalidLayout(f"{self.points} points are no map of the shape {self.shape}")
        check_attributes(self.attributes)

    @property
    def points(self) -> int:
        """Number of points."""
        return int(self.values.shape[0])

    def _is_map(self) -> bool:
        if not (
            len(self.shape) == len(self.parameters) == 2 and math.prod(self.shape) == self.points
        ):
            return False
        y, x = (column for _, column in self.coordinates.values())
        found = on_map(y, x, self.order)
        return np.array_equal(found, self.values, equal_nan=True)

    @property
    def schema(self) -> int:
        """Schema of the store."""
        return STUDY_SCHEMAS[len(self.shape) - 1]

    @property
    def dimensions(self) -> list[str]:
        """Names of the axes of what has one number a point."""
        return ["point"] if len(self.shape) == 1 else ["y", "x"]

    @cached_property
    def order(self) -> Integers:
        """(points,) index of each point of a map in arrays over (y, x), row by row."""
        return order_of(self.attributes.get("job", {}), self.shape)

    @cached_property
    def coordinates(self) -> dict[str, tuple[Channel, NDArray[np.float64]]]:
        """The parameter along each axis of a map, with its values; none on one axis."""
        if len(self.shape) == 1:
            return {}
        table = over_axes(self.values, self.order, self.shape)
        along_y, along_x = self.parameters
        return {"y": (along_y, table[:, 0, 0]), "x": (along_x, table[0, :, 1])}

    @cached_property
    def chunk(self) -> tuple[int, int]:
        """Points and sections in one chunk of the arrays of sections, which is one file.

        Its points divide most of the numbers at which blocks begin, so that few chunks belong to
        two blocks; those are written when the study is sealed. Chunks of less than eight points are
        not worth that: then many are. A chunk holds several points only with all their sections;
        otherwise each would wait for the slowest of them.
        """
        sections = max(min(self.record, CHUNK_SECTIONS), 1)
        most = _CHUNK_VALUES // sections if self.record <= sections else 1
        most = max(min(most, self.points), 1)
        begins = np.array([first for first, _ in self.blocks[1:]], dtype=np.int64)
        if not len(begins):
            return most, sections
        largest = min(most, max(count for _, count in self.blocks))
        aligned = (d for d in range(largest, 0, -1) if np.mean(begins % d == 0) >= _MOSTLY)
        found = next(aligned)
        return (found if found >= min(most, _FEWEST_POINTS) else most), sections

    @cached_property
    def digest(self) -> str:
        """SHA-256 over arrays, values and attributes: stores of one digest are one store."""
        shape = [
            self.schema,
            [self.parameters, self.observables, self.channels],
            self.record,
            self.blocks,
            sha256(np.ascontiguousarray(self.values, dtype="<f8").tobytes()).hexdigest(),
            self.attributes,
            *([self.shape] if self.coordinates else []),
        ]
        return sha256(json.dumps(shape).encode()).hexdigest()


def on_map(y: NDArray[np.float64], x: NDArray[np.float64], order: Integers) -> NDArray[np.float64]:
    """Return (points, 2) the values of y and x at each point of a map; see `StudyLayout.order`."""
    rows, columns = np.divmod(order, len(x))
    return np.column_stack([y[rows], x[columns]])
