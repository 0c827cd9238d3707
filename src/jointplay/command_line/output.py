"""Output of commands: one JSON document for programs, lines and aligned tables for people."""

import json
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import typer

from jointplay.command_line.exits import Stopped
from jointplay.records.strict_json import finite


def tell(document: object, lines: Iterable[object], *, as_json: bool) -> None:
    """Print what a command found: the document, or else the lines."""
    for line in [json_text(document)] if as_json else lines:
        typer.echo(line)


def remark(lines: Iterable[str]) -> None:
    """Print what users should know, and what ends nothing, to stderr."""
    for line in lines:
        typer.echo(f"jointplay: {line}", err=True)


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
