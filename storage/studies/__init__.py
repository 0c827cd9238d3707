"""Results of a study: one Zarr v3 store that the workers of its blocks fill together.

`create` makes the store and `seal` finishes it; a `StudyBlock` takes what one block computes, and
`StudyReader` reads everything, also while it grows. The package knows nothing of mechanisms.
"""

from storage.studies.block import StudyBlock
from storage.studies.layout import StudyLayout
from storage.studies.part import Failure, PointStatus
from storage.studies.reader import Extremes, StudyReader
from storage.studies.store import create, seal

__all__ = [
    "Extremes",
    "Failure",
    "PointStatus",
    "StudyBlock",
    "StudyLayout",
    "StudyReader",
    "create",
    "seal",
]
