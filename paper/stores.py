"""The results of a reproduction: one store for each run, by its name."""

from functools import cache
from pathlib import Path

from jointplay.paper import cases
from jointplay.paper.variants import Variant
from jointplay.storage.results import ResultReader
from jointplay.storage.studies import StudyReader


class Stores:
    """Readers of the stores that `runs.compute` left in a folder; names as in `cases.name`."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._run, self._study = cache(ResultReader), cache(StudyReader)

    def path(self, kind: str, which: object, variant: Variant | None = None) -> Path:
        """Return the file of a store."""
        return self._folder / cases.name(kind, which, variant)

    def run(self, kind: str, which: object, variant: Variant | None = None) -> ResultReader:
        """Open the results of a simulation, once."""
        return self._run(self.path(kind, which, variant))

    def study(self, kind: str, which: object, variant: Variant) -> StudyReader:
        """Open the results of a study, once."""
        return self._study(self.path(kind, which, variant))
