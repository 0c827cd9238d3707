"""Tables as files: one file a form, named by this registry.

Each module has ``SUFFIXES`` (the first is the usual one), ``MEDIA_TYPE``, ``NEEDS`` (a package that
comes with an extra, or None) and ``encode(columns, complete)``, which returns the file's bytes.
"""

from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import PurePath
from types import ModuleType
from typing import Final

from jointplay.records.table_files import (
    arrow,
    arrow_file,
    csv,
    json,
    matlab,
    npz,
    parquet,
)
from jointplay.records.table_files.column import Column, apart

__all__ = ["FORMS", "SUFFIXES", "Column", "NotInstalled", "UnknownForm", "encode", "form_of"]

FORMS: Final[tuple[ModuleType, ...]] = (csv, json, npz, matlab, arrow_file, arrow, parquet)
SUFFIXES: Final = tuple(suffix for form in FORMS for suffix in form.SUFFIXES)


class UnknownForm(ValueError):
    """No form of tables has this suffix; the sentence lists those that there are."""


class NotInstalled(ImportError):
    """A form needs a package that is not there; the sentence says how to get it."""


def form_of(path: PurePath | str) -> ModuleType:
    """Return the form that the suffix of a file's name means.

    Raises
    ------
    UnknownForm
        There is none.
    NotInstalled
        It needs a package that is not there.
    """
    suffix = PurePath(path).suffix
    for form in FORMS:
        if suffix in form.SUFFIXES:
            if form.NEEDS is not None and find_spec(form.NEEDS) is None:
                extra = "pip install 'jointplay[arrow]'"
                raise NotInstalled(f"{path}: {suffix} needs {form.NEEDS}: {extra}.")
            return form
    *others, last = SUFFIXES
    raise UnknownForm(f"{path}: tables are written as {', '.join(others)} or {last}.")


def encode(path: PurePath | str, columns: Sequence[Column], *, complete: bool) -> bytes:
    """Return a table as the bytes of the file that a name means; errors of `form_of`.

    Parameters
    ----------
    columns
        All of one length.
    complete
        Whether the run came to its end; in all files but CSV.
    """
    content: bytes = form_of(path).encode(apart(columns), complete=complete)
    return content
