"""``jointplay calibrate``: parameters of a scene that give measured numbers."""

import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from jointplay.command_line.calibration_options import calibration_document
from jointplay.command_line.compact_json import compact_json
from jointplay.command_line.exits import Exit, Stopped
from jointplay.command_line.options import PROCESSES, SET

if TYPE_CHECKING:
    from jointplay.solver.calibration.outcome import Outcome
    from jointplay.solver.calibration.problem import Calibration


def calibrate(
    source: Annotated[
        str,
        typer.Argument(
            metavar="FILE.json|SCENE.json|PRESET",
            help="A calibration, or what one left (it is repeated); a scene with options.",
        ),
    ],
    settings: SET = None,
    fit: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME=MIN:MAX[:log]", help="A parameter that may move; repeat it for others."
        ),
    ] = None,
    target: Annotated[
        list[str] | None,
        typer.Option(
            metavar="CHANNEL[:STATISTIC][@FROM:TO]=VALUE",
            help="What a channel shall give, by default its maximum; else what the scene reports.",
        ),
    ] = None,
    duration: Annotated[
        float | None, typer.Option(metavar="SECONDS", help="End of windows that are left open.")
    ] = None,
    tolerance: Annotated[
        float | None, typer.Option(help="Error that one step may make, relative to the scene.")
    ] = None,
    population: Annotated[int | None, typer.Option(help="Candidates a parameter.")] = None,
    generations: Annotated[int | None, typer.Option(help="Most generations of the search.")] = None,
    seed: Annotated[int | None, typer.Option(help="The same seed finds the same.")] = None,
    factor: Annotated[
        float | None, typer.Option(help="How many times the best cost is equally good.")
    ] = None,
    processes: PROCESSES = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON instead of tables.")] = False,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="FILE", help="Write the JSON there.")
    ] = None,
    preset_out: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Write the scene with what was found as defaults."),
    ] = None,
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
    from jointplay.solver.calibration.problem import admit_calibration

    calibration = admit_calibration(
        calibration_document(
            source,
            settings=settings or (),
            fits=fit or (),
            targets=target or (),
            duration=duration,
            search={"population": population, "generations": generations, "seed": seed},
            spread={"factor": factor},
            tolerance=tolerance,
        )
    )
    outcome = computed(calibration, processes)
    document = compact_json(outcome.document())
    if output is not None:
        output.write_text(document + "\n")
    if preset_out is not None:
        from jointplay.solver.calibration.fitted_scene import fitted_scene

        name = re.sub(r"[^A-Za-z0-9-]", "-", preset_out.stem)[:32]
        preset_out.write_text(compact_json(fitted_scene(outcome, name)) + "\n")
    for line in [document] if as_json else calibration_lines(outcome):
        typer.echo(line)


def computed(calibration: "Calibration", processes: int | None) -> "Outcome":
    """Carry out a calibration with a bar on stderr; Stopped if nothing fits."""
    from concurrent.futures.process import BrokenProcessPool

    from jointplay.progress import progress

    with progress("calibrate") as report:
        report(0.0, "preparing the kernels")
        from jointplay.solver.calibration import calibrate as search
        from jointplay.solver.calibration.measure import measures
        from jointplay.solver.runs.processes import cores

        try:
            with measures(calibration, processes or cores()) as (fitted, every):
                outcome = search.calibrate(calibration, fitted, every, report)
        except search.NothingFits as nothing:
            raise Stopped(str(nothing), Exit.FAILED) from None
        except BrokenProcessPool:
            line = "a process that computed candidates died; nothing was found"
            raise Stopped(line, Exit.FAILED) from None
        report(1.0, f"{len(outcome.found.costs) + outcome.good.tried} candidates")
    return outcome
