"""A store opened for reading: its files, checked by its manifest and read by stock zarr."""

from collections.abc import Callable
from functools import cached_property
from pathlib import Path
from typing import Any, cast

import zarr

from jointplay.storage.packed import Files, Packed, files_at
from jointplay.storage.packed.zarr_store import FilesStore
from jointplay.storage.results import manifest


class StoreReader:
    """One store, sealed or growing.

    Parameters
    ----------
    source
        Its files, or the path of a packed store or of the folder of one that is being filled.
    """

    def __init__(self, source: Files | Path) -> None:
        self.files = files_at(source) if isinstance(source, Path) else source

    @property
    def sealed(self) -> bool:
        """Nothing will be added any more."""
        return isinstance(self.files, Packed)

    def verify(self, advanced: Callable[[], None] = lambda: None) -> None:
        """Compare every file with the manifest; `advanced` is called before each.

        Raises
        ------
        NotAStore
            The store is not sealed.
        CorruptStore
            A file is missing, differs or was added.
        """
        manifest.verify(self.files, advanced)

    def _array(self, key: str) -> zarr.Array[Any]:
        return cast("zarr.Array[Any]", self._root[key])

    @cached_property
    def _root(self) -> zarr.Group:
        return self._group("")

    def _group(self, path: str) -> zarr.Group:
        """Open a group alone: without a look at hundreds of arrays beside it."""
        return zarr.open_group(FilesStore(self.files), path=path, mode="r", zarr_format=3)
