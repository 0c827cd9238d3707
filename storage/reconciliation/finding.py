"""One thing of an installation that is not as it should be."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Finding:
    """Something that is wrong, with what, and what comes of it.

    `mended` says what `mend` does to it, as a participle; `advice` what is left to the user, most
    often a command.
    """

    where: str
    """Part of the installation, such as ``catalogue`` or ``results``."""
    subjects: tuple[str, ...]
    found: str
    mended: str | None = None
    advice: str | None = None
    mend: Callable[[], object] | None = None

    @property
    def subject(self) -> str:
        """The first subject, and how many there are."""
        more = len(self.subjects) - 1
        return f"{self.subjects[0]} and {more} more" if more else self.subjects[0]

    def document(self) -> dict[str, Any]:
        """Return it as JSON has it."""
        names = ("where", "subjects", "found", "mended", "advice")
        return {name: getattr(self, name) for name in names}
