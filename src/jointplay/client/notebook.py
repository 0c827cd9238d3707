"""Representations in notebooks: small tables, and figures as pictures."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from html import escape
from pathlib import Path

from jointplay.records.figure_form import FORMS, Form
from jointplay.records.whole_file import write_whole


def html_table(title: str, rows: Mapping[str, object]) -> str:
    """Return a small table; rows without a value are left out."""
    cells = "".join(
        f"<tr><th style='text-align:left'>{escape(name)}</th>"
        f"<td style='text-align:left'>{escape(str(value))}</td></tr>"
        for name, value in rows.items()
        if value not in (None, "")
    )
    return f"<table><caption>{escape(title)}</caption><tbody>{cells}</tbody></table>"


@dataclass(frozen=True)
class Picture:
    """A drawn figure: the ``content`` of a file, and its ``form``, such as "png"."""

    content: bytes
    form: Form
    _draw: Callable[[Form], bytes] = field(repr=False, compare=False)

    def __repr__(self) -> str:
        return f"<Picture: {self.form}, {len(self.content)} bytes>"

    def _repr_png_(self) -> bytes | None:
        return self.content if self.form == "png" else None

    def _repr_svg_(self) -> str | None:
        return self.content.decode() if self.form == "svg" else None

    def save(self, path: Path | str) -> Path:
        """Write the file, whole or not at all, and return its path.

        A suffix that names another form, such as ``.pdf``, draws the figure again in that form;
        without one its own is appended.
        """
        file = Path(path)
        asked = next((form for form in FORMS if file.suffix == f".{form}"), None)
        if asked is None:
            file = file.with_name(f"{file.name}.{self.form}")
        write_whole(file, self.content if asked in (None, self.form) else self._draw(asked))
        return file
