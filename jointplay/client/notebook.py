"""Representations in notebooks: small tables, and figures as pictures."""

from collections.abc import Mapping
from html import escape
from pathlib import Path
from typing import NamedTuple

from jointplay.client.results import Form


def html_table(title: str, rows: Mapping[str, object]) -> str:
    """Return a small table; rows without a value are left out."""
    cells = "".join(
        f"<tr><th style='text-align:left'>{escape(name)}</th>"
        f"<td style='text-align:left'>{escape(str(value))}</td></tr>"
        for name, value in rows.items()
        if value not in (None, "")
    )
    return f"<table><caption>{escape(title)}</caption><tbody>{cells}</tbody></table>"


class Picture(NamedTuple):
    """A drawn figure: the ``content`` of a file, and its ``form``, "png" or "svg"."""

    content: bytes
    form: Form

    def __repr__(self) -> str:
        return f"<Picture: {self.form}, {len(self.content)} bytes>"

    def _repr_png_(self) -> bytes | None:
        return self.content if self.form == "png" else None

    def _repr_svg_(self) -> str | None:
        return self.content.decode() if self.form == "svg" else None

    def save(self, path: Path | str) -> Path:
        """Write the file, and return its path; the suffix is appended if it is missing."""
        file = Path(path)
        if file.suffix != f".{self.form}":
            file = file.with_name(f"{file.name}.{self.form}")
        file.write_bytes(self.content)
        return file
