"""The table of results that a run leaves beside its store: text that follows from the store."""

from collections.abc import Iterator, Mapping
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from jointplay.records.whole_file import write_whole

if TYPE_CHECKING:
    from jointplay.storage.reconciliation import Finding


def table_of(found: Mapping[str, Any]) -> tuple[str, str] | None:
    """Return name and text of the table of some results; None where there are none.

    `found` : as `summary.results_of` returns it.
    """
    from jointplay.command_line.output import json_text
    from jointplay.command_line.peaks import peak_lines
    from jointplay.exports.study import point_lines

    for name in ("accuracy", "calibration"):
        if found[name] is not None:
            return f"{name}.json", json_text(found[name]) + "\n"
    if (study := found["points"]) is not None:
        channels = [channel.name for channel in study.channels]
        return "points.csv", "".join(point_lines(study, channels, range(study.points)))
    if found["peaks"] is None:  # a calibration that did not come to its end has nothing
        return None
    return "peaks.csv", "".join(peak_lines(found["peaks"]))


def wrong_tables(folder: Path) -> "Iterator[Finding]":
    """Yield the table in a run's folder if it is there and is not that of the store."""
    from jointplay.client import NotFound
    from jointplay.command_line.summary import results_of
    from jointplay.local import load
    from jointplay.storage.errors import ResultsError
    from jointplay.storage.reconciliation import Finding
    from jointplay.worker.local.folder import STORE

    if not (folder / STORE).exists():  # what goes on writes its table at its end
        return
    with suppress(ResultsError, NotFound):  # which is found where the store is looked at
        table = table_of(results_of(load(folder)))
        if table is None:
            return
        name, text = table
        path = folder / name
        if path.exists() and path.read_bytes() != text.encode():
            mend = partial(write_whole, path, text)
            yield Finding(
                str(folder), (name,), f"is not the table of {STORE}", "written anew", mend=mend
            )
