"""Results of one attempt of a job: a Zarr v3 store that is written shard by shard.

`ResultWriter` fills a store, `ResultReader` reads it, also while it grows; `ResultLayout` says
what it holds. The package stores named columns over time and knows nothing of their meaning.
"""

from jointplay.storage.errors import (
    CheckpointMismatch,
    CorruptStore,
    InvalidAppend,
    InvalidLayout,
    NotAStore,
    ResultsError,
    StoreExists,
    StoreSealed,
    UnknownChannel,
)
from jointplay.storage.results.layout import Partition, ResultLayout
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.results.writer import ResultWriter

__all__ = [
    "CheckpointMismatch",
    "CorruptStore",
    "InvalidAppend",
    "InvalidLayout",
    "NotAStore",
    "Partition",
    "ResultLayout",
    "ResultReader",
    "ResultWriter",
    "ResultsError",
    "StoreExists",
    "StoreSealed",
    "UnknownChannel",
]
