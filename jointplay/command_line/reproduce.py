"""``jointplay reproduce``: a publication computed again, its numbers beside ours in one page."""

from pathlib import Path
from typing import Annotated

import typer

from jointplay.command_line.exits import Exit, Stopped
from jointplay.command_line.options import AS_JSON, PROCESSES
from jointplay.command_line.output import make_folder, tell


def reproduce(
    output: Annotated[
        Path,
        typer.Option("-o", "--output", metavar="OUT", help="Folder to make; must not exist."),
    ] = Path("reproduction"),
    quick: Annotated[
        bool, typer.Option("--quick", help="Little of everything, in seconds: to see it work.")
    ] = False,
    processes: PROCESSES = None,
    as_json: AS_JSON = False,
) -> None:
    """Compute the published figures of the press again, and set every printed number beside ours.

    OUT gets report.html, which needs nothing beside itself, and runs/ with the results of every
    job.  Takes some ten minutes on two cores, longer when kernels have to be compiled first.

    Example: `jointplay reproduce -o reproduction`
    """
    from concurrent.futures.process import BrokenProcessPool

    from jointplay.paper.reproduction import RunFailed
    from jointplay.paper.reproduction import reproduce as whole
    from jointplay.paper.variants import FULL, QUICK
    from jointplay.progress import progress
    from jointplay.solver.runs.processes import Interrupted

    make_folder(output)
    try:
        with progress("reproducing") as report:
            page = whole(output, QUICK if quick else FULL, processes, report)
    except Interrupted:
        line = f"interrupted; {output} has no report, remove it before you start again."
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
    tell({"report": str(page), "runs": str(runs)}, [line, forces], as_json=as_json)
