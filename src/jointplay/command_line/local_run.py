"""A job computed here and now for a command: results, tables, figures, and what is told of them."""

import shlex
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from jointplay.command_line.exits import Exit, Stopped
from jointplay.command_line.figure_paths import FigurePaths
from jointplay.command_line.output import print_result
from jointplay.records.whole_file import write_whole
from jointplay.records.window_query import WindowQuery

if TYPE_CHECKING:
    from jointplay.client import Job
    from jointplay.solver.kinds import Admission, Study
    from jointplay.worker.local.devices import Lanes


def compute_and_show(
    admission: "Admission | Study | None",
    output: Path,
    processes: int | None,
    device: "Lanes | None",
    *,
    figures: bool,
    as_json: bool,
) -> None:
    """Compute, if anything is left to; write tables and figures; print what came of it."""
    from jointplay.command_line.plot import draw_all
    from jointplay.command_line.summary import document_of, results_of
    from jointplay.local import load
    from jointplay.progress import progress
    from jointplay.worker.local.computing import NO_ROOM, compute

    if admission is not None:
        with progress(output.name) as report:
            compute(admission, output, processes, report, device)
    job = load(output)
    if job.error is not None and job.error.code == NO_ROOM:
        raise Stopped(f"{job.error.detail} {_go_on(output)}", Exit.FAILED)
    found = results_of(job)
    table = _write(found, output)
    if figures:
        draw_all(job, FigurePaths(output / "figures"))
    document = document_of(job, found)
    del document["statistics"]
    print_result(document, _lines(job, found, table), as_json=as_json)
    if job.state == "cancelled":
        line = f"{output} was cancelled at {job.done_so_far}. {_go_on(output)}"
        raise Stopped(line, Exit.CANCELLED)
    job.check()
    points = document["points"]
    if points is not None and len(points["failures"]) == points["number"]:
        raise Stopped("every point failed; the first one says why above", Exit.FAILED)


def _go_on(output: Path) -> str:
    return f"To go on: jointplay run --resume {shlex.quote(str(output))}"


def _write(found: dict[str, Any], output: Path) -> Path:
    """Write the table of results into the folder, and return its path."""
    from jointplay.command_line.result_table import table_of

    if (table := table_of(found)) is None:
        return output
    name, text = table
    write_whole(output / name, text)
    return output / name


def _lines(job: "Job", found: dict[str, Any], table: Path) -> Iterator[str]:
    from jointplay.command_line.peaks import headline
    from jointplay.command_line.summary import result_lines

    peaks, points = found["peaks"], found["points"]
    first = () if peaks is None else headline(job.results.source(WindowQuery()))
    yield from result_lines(job, found, first)
    if peaks is not None:
        yield f"all {len(peaks)} channels are in {table}"
    if points is not None:
        yield f"the table of points is {table}"
