"""``jointplay accuracy``: what every method and tolerance costs and buys on one scene."""

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any

import typer

from jointplay.command_line.exits import Stopped
from jointplay.command_line.figure_options import form_of
from jointplay.command_line.job_document import job_document
from jointplay.command_line.job_options import with_job_options
from jointplay.command_line.options import AS_JSON, JOB, SET
from jointplay.command_line.output import json_text, print_result
from jointplay.records.whole_file import write_whole

_OF_A_RUN = ("scene", "duration", "formulation", "label")


@with_job_options("duration")
def accuracy(
    source: JOB,
    settings: SET = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE",
            help="A work-precision diagram: .png, .svg, .pdf, .eps; or its numbers: .json.",
        ),
    ] = None,
    as_json: AS_JSON = False,
    **options: Any,
) -> None:
    """Measure what every method and tolerance costs and buys on a scene, and recommend one.

    Each is run over the duration, by default one period of the drivers, and compared with a
    reference run for as long as that is known. It takes up to a minute. `jointplay run
    --accuracy-study` does the same and keeps it.

    Example: `jointplay accuracy seven-bar-press --set clearance=3e-4 -o trade.svg`
    """
    from jointplay.local import run

    form = None
    if output is not None and output.suffix != ".json":
        form = form_of(output, ".json")
    job = job_document(source, settings=settings, options=options)
    if job.get("kind") == "simulate":
        chosen = {name: job[name] for name in _OF_A_RUN if name in job}
        job = {"kind": "accuracy-study", **chosen}
    if job.get("kind") != "accuracy-study":
        raise Stopped(f"{source} is a {job.get('kind')}; give one simulation.")
    measured = run(job, progress=True)
    found = measured.accuracy
    if output is not None and form is None:
        write_whole(output, json_text(found) + "\n")
    elif output is not None and form is not None:
        write_whole(output, measured.figure("work-precision", form=form).content)
    print_result(found, accuracy_lines(found), as_json=as_json)


def accuracy_lines(found: dict[str, Any]) -> Iterator[str]:
    """Yield an accuracy-study as far as it has come: what the columns mean, a table, the advice."""
    if found["uncertainty"] is not None:
        yield (
            f"Error: root mean square over the first {found['window']:.3g} s, in which the"
            f" reference is known to {found['uncertainty']:.0e}, relative to the scene's scales."
        )
    yield (
        f"Cost, and energy residual divided by what contacts and friction take: of"
        f" {found['duration']:.3g} s."
    )
    yield ""
    yield "| method | tolerance or step | error | energy residual | steps | evaluations | ms |"
    yield "|---|---|---|---|---|---|---|"
    for run in found["points"]:
        how = f"{run['tolerance']:.0e}" if run["tolerance"] else f"{run['step']:.2g} s"
        how += "" if run["admitted"] else " (refused)"
        error = "fails" if run["failure"] else "unknown"
        error = error if run["error"] is None else f"{run['error']:.1e}"
        share = run["relative_energy_residual"]
        residual = "" if share is None else f"{share:.1e}"
        cost = f"{run['steps']} | {run['evaluations']} | {1e3 * run['seconds']:.1f}"
        yield f"| {run['method']} | {how} | {error} | {residual} | {cost} |"
    yield ""
    if found["advice"] is not None:
        yield found["advice"]
