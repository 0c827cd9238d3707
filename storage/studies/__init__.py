"""Results of a study: one Zarr v3 store that the workers of its blocks fill together.

`create` makes the store and `seal` finishes it; a `StudyBlock` takes what one block computes, and
`StudyReader` reads everything, also while it grows. The package knows nothing of mechanisms.
"""

from jointplay.storage.studies.block import StudyBlock
from jointplay.storage.studies.layout import StudyLayout
from jointplay.storage.studies.reader import StudyReader
from jointplay.storage.studies.store import create, seal

__all__ = [
    "StudyBlock",
    "StudyLayout",
    "StudyReader",
    "create",
    "seal",
]
