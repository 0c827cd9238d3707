"""``jointplay chaos``: a service of its own under faults, and whether it kept its word."""

import shutil
import tempfile
from pathlib import Path
from typing import Annotated

import typer

from jointplay.command_line.exits import Exit, Stopped
from jointplay.command_line.options import AS_JSON
from jointplay.command_line.output import aligned, make_folder, print_result

SEED = Annotated[int, typer.Option(min=0, help="Of jobs and schedule.")]
DURATION = Annotated[float, typer.Option(min=1.0, max=86_400.0, help="In which faults strike, s.")]
FAULT = Annotated[
    list[str] | None,
    typer.Option(metavar="NAME", help="Only this one; repeatable. Default all."),
]
WORKERS = Annotated[int, typer.Option(min=1, max=64, help="How many workers.")]
CATALOGUE = Annotated[
    str,
    typer.Option(
        metavar="URL", help="Empty database, postgresql://USER@HOST/NAME. Default a file."
    ),
]
RESULTS = Annotated[
    str,
    typer.Option(
        metavar="URL",
        help="Empty object store, s3://BUCKET/PREFIX?endpoint=http://HOST. Default a folder.",
    ),
]
OUTPUT = Annotated[
    Path | None,
    typer.Option(
        "-o", "--output", metavar="FOLDER", help="Where it works; must not exist, and stays."
    ),
]


def chaos(
    seed: SEED = 0,
    duration: DURATION = 180.0,
    fault: FAULT = None,
    workers: WORKERS = 2,
    catalogue: CATALOGUE = "",
    results: RESULTS = "",
    output: OUTPUT = None,
    as_json: AS_JSON = False,
) -> None:
    """Let faults strike a service made for it, on this machine, and check what it made of them.

    Jobs of every kind are submitted while processes are killed and stopped, and more.  At the end
    every accepted job must have ended once, with the bytes of an undisturbed run, and nothing may
    be left over; else the exit code is 1, and everything is kept.  No other service is touched.

    Example: `jointplay chaos --seed 7 --duration 600`
    """
    from jointplay.chaos.program import carry_out, names
    from jointplay.chaos.servers import NotEmpty, require_empty

    for name in fault or ():
        if name not in names():
            raise Stopped(f"there is no fault {name!r}; there are {', '.join(names())}")
    try:
        require_empty(catalogue, results)
    except NotEmpty as error:
        raise Stopped(str(error)) from None
    folder = Path(tempfile.mkdtemp(prefix="jointplay-chaos-")) if output is None else output
    if output is not None:
        make_folder(output)
    try:
        report = carry_out(
            folder.absolute(),
            seed=seed,
            duration=duration,
            faults=fault or names(),
            workers=workers,
            servers=(catalogue, results),
        )
    except KeyboardInterrupt:
        line = f"interrupted; what it left is in {folder}"
        raise Stopped(line, Exit.INTERRUPTED) from None
    if output is None and not report.wrong:
        shutil.rmtree(folder)
    lines = [*aligned([*report.rows()]), *report.closing()]
    print_result(report.document(), lines, as_json=as_json)
    if report.wrong:
        raise Stopped(f"{len(report.wrong)} things were wrong", Exit.CHECK_FAILED)
