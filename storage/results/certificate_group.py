"""A group of small arrays that a store gets when it is sealed, such as a run's certificate."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import zarr
from numpy.typing import NDArray

from jointplay.storage.results import shards
from jointplay.storage.results.metadata import Document, array, group

CERTIFICATE: Final = "certificate"
"""The one group of this kind that there is."""

_DOUBLE: Final = np.dtype("<f8")


@dataclass(frozen=True)
class SmallArray:
    """Doubles of any shape, with a name for each dimension, units and meaning."""

    values: NDArray[np.float64]
    dimensions: tuple[str, ...]
    attributes: dict[str, Any]


@dataclass(frozen=True)
class Appendix:
    """A JSON document of finite numbers, and arrays by name."""

    attributes: dict[str, Any]
    arrays: Mapping[str, SmallArray]

    def documents(self, name: str) -> dict[str, Document]:
        """Make the documents of the group of that name, by the paths of their nodes."""
        arrays = {
            key: array(
                one.values.shape,
                [max(length, 1) for length in one.values.shape],
                _DOUBLE,
                one.dimensions,
                one.attributes,
            )
            for key, one in self.arrays.items()
        }
        below = {f"{name}/{key}": document for key, document in arrays.items()}
        return {name: group(self.attributes, arrays)} | below

    def chunks(self, name: str) -> dict[str, bytes]:
        """Encode the arrays, each as one chunk, by key; those without values have none."""
        return {
            f"{name}/{key}/c/{'/'.join('0' for _ in one.dimensions)}": shards.compress(
                one.values.astype(_DOUBLE, copy=False)
            )
            for key, one in self.arrays.items()
            if one.values.size
        }


def read_appendix(root: zarr.Group, name: str) -> Appendix | None:
    """Read a group; None if the store has none of that name."""
    found = root.get(name)
    if not isinstance(found, zarr.Group):
        return None
    arrays = {
        key: SmallArray(
            np.asarray(one[...], np.float64),
            tuple(str(dimension) for dimension in one.metadata.dimension_names or ()),  # type: ignore[union-attr]
            dict(one.attrs),
        )
        for key, one in found.arrays()
    }
    return Appendix(dict(found.attrs), arrays)
