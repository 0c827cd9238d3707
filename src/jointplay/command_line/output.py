"""Output of commands: one JSON document for programs, lines and aligned tables for people."""

import json
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Final
from unicodedata import bidirectional, category

import typer

from jointplay.command_line.exits import Stopped
from jointplay.records.strict_json import finite

_TURNS: Final = frozenset({"LRE", "RLE", "LRO", "RLO", "PDF", "LRI", "RLI", "FSI", "PDI"})
"""Classes of characters that embed or override a direction of writing."""


def print_result(document: object, lines: Iterable[object], *, as_json: bool) -> None:
    """Print what a command found: the document, or else the lines."""
    for line in [json_text(document)] if as_json else map(visible, map(str, lines)):
        typer.echo(line)


def remark(lines: Iterable[str]) -> None:
    """Print what users should know, and what ends nothing, to stderr."""
    for line in lines:
        typer.echo(f"jointplay: {visible(line)}", err=True)


def visible(text: str, *, kept: str = "\n\t") -> str:
    """Return a text with escapes in place of characters that terminals obey, but for those kept.

    Labels and names are others' texts, which could clear a screen, or turn a line round.
    """
    return "".join(ascii(one)[1:-1] if _is_obeyed(one) and one not in kept else one for one in text)


def _is_obeyed(character: str) -> bool:
    return category(character) in ("Cc", "Zl", "Zp") or bidirectional(character) in _TURNS


def print_json(document: object) -> None:
    """Print a document."""
    typer.echo(json_text(document))


def json_text(document: object) -> str:
    """Return a document as JSON; NaN and infinity, which JSON does not have, become null."""
    return json.dumps(finite(document), indent=2, allow_nan=False)


def aligned(rows: Sequence[Sequence[str]]) -> Iterator[str]:
    """Yield the rows with their cells below one another."""
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    for row in rows:
        cells = (cell.ljust(width) for cell, width in zip(row, widths, strict=True))
        yield "  ".join(cells).rstrip()


def make_folder(output: Path) -> None:
    """Make a folder for results, which must not be there yet."""
    try:
        output.mkdir(parents=True)
    except FileExistsError:
        line = f"{output} exists already; results are never overwritten, name another folder."
        raise Stopped(line) from None
