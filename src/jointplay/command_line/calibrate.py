"""``jointplay calibrate``: parameters of a scene that give measured numbers."""

import re
import shlex
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from jointplay.command_line.calibration_options import calibration_document
from jointplay.command_line.compact_json import compact_json
from jointplay.command_line.exits import Exit, Stopped
from jointplay.command_line.options import PROCESSES, SET, whole
from jointplay.records.calibration_misfit import with_misfits
from jointplay.records.whole_file import write_whole

if TYPE_CHECKING:
    from jointplay.solver.calibration.outcome import Outcome
    from jointplay.solver.calibration.problem import Calibration

SOURCE = Annotated[
    str | None,
    typer.Argument(
        metavar="FILE.json|SCENE.json|PRESET",
        help="A calibration, or what one left (it is repeated); a scene with options.",
    ),
]
FIT = Annotated[
    list[str] | None,
    typer.Option(
        metavar="NAME=MIN:MAX[:log]", help="A parameter that may move; repeat it for others."
    ),
]
TARGET = Annotated[
    list[str] | None,
    typer.Option(
        metavar="CHANNEL[:STATISTIC][@FROM:TO]=VALUE",
        help="What a channel shall give, by default its maximum; else what the scene reports.",
    ),
]
DURATION = Annotated[
    float | None, typer.Option(metavar="SECONDS", help="End of windows that are left open.")
]
TOLERANCE = Annotated[
    float | None, typer.Option(help="Error that one step may make, relative to the scene.")
]
POPULATION = Annotated[
    int | None, typer.Option(metavar="INTEGER", help="Candidates a parameter.", parser=whole)
]
GENERATIONS = Annotated[
    int | None,
    typer.Option(metavar="INTEGER", help="Most generations of the search.", parser=whole),
]
SEED = Annotated[
    int | None, typer.Option(metavar="INTEGER", help="The same seed finds the same.", parser=whole)
]
FACTOR = Annotated[float | None, typer.Option(help="How many times the best cost is equally good.")]
AS_JSON = Annotated[bool, typer.Option("--json", help="Print JSON instead of tables.")]
OUTPUT = Annotated[
    Path | None, typer.Option("-o", "--output", metavar="FILE", help="Write the JSON there.")
]
PRESET_OUT = Annotated[
    Path | None,
    typer.Option(metavar="FILE", help="Write the scene with what was found as defaults."),
]
RESUME = Annotated[
    Path | None,
    typer.Option(metavar="FILE", help="Go on with a calibration -o FILE that was cut short."),
]


def calibrate(
    source: SOURCE = None,
    settings: SET = None,
    fit: FIT = None,
    target: TARGET = None,
    duration: DURATION = None,
    tolerance: TOLERANCE = None,
    population: POPULATION = None,
    generations: GENERATIONS = None,
    seed: SEED = None,
    factor: FACTOR = None,
    processes: PROCESSES = None,
    as_json: AS_JSON = False,
    output: OUTPUT = None,
    preset_out: PRESET_OUT = None,
    resume: RESUME = None,
) -> None:
    """Fit parameters of a scene to peaks, times and ranges that are known of it.

    Finds what fits best and, since impacts make that a rough question, the spread of what fits
    equally well.  The tables show targets beside what was fitted, and how far each parameter is
    known.  The same document and seed give the same, whatever the processes.

    Examples: `jointplay calibrate calibration.json -o found.json --preset-out fitted.json`,
    `jointplay calibrate seven-bar-press --fit stiffness=1e8:1e11:log --set clearance=5e-4
    --target A.normal_force@0:0.012=1020`
    """
    from jointplay.command_line.calibration_table import calibration_lines
    from jointplay.solver.kinds import admit_calibration

    if resume is not None:
        if source is not None or output is not None:
            raise Stopped("--resume FILE goes on as it was begun; give no other calibration or -o.")
        given, output = _begun(resume), resume
    elif source is None:
        raise Stopped("Missing argument 'FILE.json|SCENE.json|PRESET': name what to calibrate.")
    else:
        given = calibration_document(
            source,
            settings=settings or (),
            fits=fit or (),
            targets=target or (),
            duration=duration,
            search={"population": population, "generations": generations, "seed": seed},
            spread={"factor": factor},
            tolerance=tolerance,
        )
    with _alone_with(output):
        outcome = computed(admit_calibration(given), processes, output)
        found = with_misfits(outcome.document())
        document = compact_json(found)
        if output is not None:
            write_whole(output, document + "\n")
            _measured_beside(output).unlink(missing_ok=True)
    if preset_out is not None:
        from jointplay.solver.calibration.fitted_scene import fitted_scene

        name = re.sub(r"[^A-Za-z0-9-]", "-", preset_out.stem)[:32]
        write_whole(preset_out, compact_json(fitted_scene(outcome, name)) + "\n")
    for line in [document] if as_json else calibration_lines(found):
        typer.echo(line)


@contextmanager
def _alone_with(output: Path | None) -> Iterator[None]:
    """Keep other processes from a file of results and what is measured for it, or be stopped."""
    from filelock import FileLock, Timeout

    if output is None or not output.parent.is_dir():  # which whatever writes there tells
        yield
        return
    lock = FileLock(output.with_name(f"{output.name}.lock"))
    try:
        lock.acquire(blocking=False)
    except Timeout as error:
        line = f"Another process calibrates for {output}; wait until that has ended."
        raise Stopped(line) from error
    try:
        yield
    finally:
        Path(lock.lock_file).unlink(missing_ok=True)
        lock.release()


def _begun(output: Path) -> dict[str, Any]:
    """Return the calibration that was begun for a file of results."""
    from jointplay.worker.local.measured import document_in

    found = document_in(_measured_beside(output))
    if found is None:
        raise Stopped(f"No calibration was begun with -o {output}, or it has come to its end.")
    return found


def computed(
    calibration: "Calibration", processes: int | None, output: Path | None = None
) -> "Outcome":
    """Carry out a calibration with a bar on stderr; Stopped if nothing fits, or by a signal.

    What it measures is kept beside the file of its results, if it will have one, so that it can go
    on there.
    """
    from concurrent.futures.process import BrokenProcessPool

    from jointplay.progress import progress
    from jointplay.worker.local.interruption import interruption

    with interruption() as asked_to_end, progress("calibrate") as report:
        report(0.0, "preparing the kernels")
        from jointplay.solver.calibration import calibrate as search
        from jointplay.solver.runs.processes import Interrupted, cores
        from jointplay.worker.local.measured import Measured
        from jointplay.worker.local.measures import measures

        kept = None if output is None else Measured(_measured_beside(output), calibration)
        try:
            with measures(calibration, processes or cores(), asked_to_end) as (fitted, every):
                if kept is not None:
                    fitted, every = kept.of(fitted, every=False), kept.of(every, every=True)
                report(0.0, "searching")  # from here on time tells how much is left
                cost = search.costs_of(calibration, fitted)
                outcome = search.calibrate(calibration, cost, every, report)
        except Interrupted:
            raise Stopped(_interrupted(output), Exit.INTERRUPTED) from None
        except search.NothingFits as nothing:
            raise Stopped(str(nothing), Exit.FAILED) from None
        except BrokenProcessPool:
            line = "a process that computed candidates died; nothing was found"
            raise Stopped(line, Exit.FAILED) from None
        report(1.0, f"{len(outcome.found.costs) + outcome.good.tried} candidates")
    return outcome


def _measured_beside(output: Path) -> Path:
    return output.with_name(f"{output.name}.measured")


def _interrupted(output: Path | None) -> str:
    if output is None:
        return "interrupted; with -o FILE what was measured is kept, and --resume FILE goes on."
    return f"interrupted. To go on: jointplay calibrate --resume {shlex.quote(str(output))}"
