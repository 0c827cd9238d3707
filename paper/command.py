"""``jointplay reproduce``: a publication computed again, its numbers beside ours in one page."""

import json
import shlex
from importlib.util import find_spec
from pathlib import Path
from typing import Annotated, Final

import typer

from jointplay.command_line.exits import Exit, Stopped
from jointplay.command_line.options import AS_JSON, PROCESSES
from jointplay.command_line.output import json_text, make_folder, print_result

if find_spec("jinja2") is None:
    raise ModuleNotFoundError("of the extra", name="jinja2")
_SIZE: Final = "reproduction.json"
"""File that says what was begun in a folder."""


def reproduce(
    output: Annotated[
        Path,
        typer.Option("-o", "--output", metavar="OUT", help="Folder to make; must not exist."),
    ] = Path("reproduction"),
    quick: Annotated[
        bool, typer.Option("--quick", help="Little of everything, in seconds: to see it work.")
    ] = False,
    resume: Annotated[
        Path | None,
        typer.Option(metavar="OUT", help="Go on with a reproduction that was cut short."),
    ] = None,
    processes: PROCESSES = None,
    as_json: AS_JSON = False,
) -> None:
    """Compute the published figures of the press again, and set every printed number beside ours.

    OUT gets report.html, which needs nothing beside itself, and runs/ with the results of every
    job.  Takes some ten minutes on two cores, longer when kernels have to be compiled first.
    Ctrl-C, SIGTERM and SIGHUP end it and keep what was computed; --resume OUT goes on from there.

    Example: `jointplay reproduce -o reproduction`
    """
    from concurrent.futures.process import BrokenProcessPool

    from jointplay.paper.reproduction import RunFailed
    from jointplay.paper.reproduction import reproduce as whole
    from jointplay.paper.variants import FULL, QUICK
    from jointplay.progress import progress
    from jointplay.solver.runs.processes import Interrupted

    if resume is not None:
        output, quick = resume, _is_quick(resume)
    else:
        make_folder(output)
        (output / _SIZE).write_text(json_text({"quick": quick}) + "\n")
    try:
        with progress("reproducing") as report:
            page = whole(output, QUICK if quick else FULL, processes, report)
    except Interrupted:
        line = f"interrupted. To go on: jointplay reproduce --resume {shlex.quote(str(output))}"
        raise Stopped(line, Exit.INTERRUPTED) from None
    except RunFailed as error:
        raise Stopped(str(error), Exit.FAILED) from None
    except BrokenProcessPool:
        raise Stopped("a process that computed a part of it died.", Exit.FAILED) from None
    runs = output / "runs"
    line = f"the report is {page}; results of all jobs are in {runs}/"
    forces = (
        "for forces take the fitted preset: right at A, half of the printed ones at B"
        " (docs/calibration.md)"
    )
    print_result({"report": str(page), "runs": str(runs)}, [line, forces], as_json=as_json)


def _is_quick(output: Path) -> bool:
    """Return whether a reproduction was begun as a quick one."""
    try:
        return bool(json.loads((output / _SIZE).read_bytes())["quick"])
    except (OSError, ValueError, KeyError, TypeError):
        raise Stopped(f"No reproduction was begun in {output}.") from None
