"""``jointplay accuracy``: what every method and tolerance costs and buys on one scene."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from jointplay.command_line import job_document
from jointplay.command_line.exits import Exit, Stopped
from jointplay.command_line.job_options import with_job_options
from jointplay.command_line.output import AS_JSON, json_text, print_json

if TYPE_CHECKING:
    from jointplay.command_line.drawing import Form

_OF_A_RUN = ("scene", "duration", "formulation", "label")


@with_job_options("duration")
def accuracy(
    source: job_document.JOB,
    settings: job_document.SET = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE",
            help="A work-precision diagram, .png or .svg; or .json.",
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

    if output is not None and output.suffix not in (".png", ".svg", ".json"):
        raise Stopped(Exit.BAD_INPUT, f"{output}: the name ends in .png, .svg or .json.")
    job = job_document.job_document(source, settings=settings, options=options)
    if job.get("kind") == "simulate":
        chosen = {name: job[name] for name in _OF_A_RUN if name in job}
        job = {"kind": "accuracy-study", **chosen}
    if job.get("kind") != "accuracy-study":
        raise Stopped(Exit.BAD_INPUT, f"{source} is a {job.get('kind')}; give one simulation.")
    measured = run(job, progress=True)
    found = measured.accuracy
    if output is not None and output.suffix == ".json":
        output.write_text(json_text(found) + "\n")
    elif output is not None:
        form: Form = "svg" if output.suffix == ".svg" else "png"
        output.write_bytes(measured.figure("work-precision", form=form).content)
    print_json(found) if as_json else print_accuracy(found)


def print_accuracy(found: dict[str, Any]) -> None:
    """Print an accuracy-study as far as it has come: its table and its advice."""
    typer.echo(table(found))
    if found["advice"] is not None:
        typer.echo(found["advice"])


def table(found: dict[str, Any]) -> str:
    """Return an accuracy-study as a table in Markdown, with what the columns mean."""
    lines = [
        f"Cost and energy astray, as a share of what contacts and friction take: of"
        f" {found['duration']:.3g} s.",
        "",
        "| method | tolerance or step | error | energy astray | steps | evaluations | ms |",
        "|---|---|---|---|---|---|---|",
    ]
    if found["window"] is not None:
        lines.insert(
            0,
            f"Error: root mean square over the first {found['window']:.3g} s, in which the"
            f" reference is known to {found['uncertainty']:.0e}, relative to the scene's scales.",
        )
    for run in found["points"]:
        how = f"{run['tolerance']:.0e}" if run["tolerance"] else f"{run['step']:.2g} s"
        how += "" if run["admitted"] else " (refused)"
        error = "fails" if run["error"] is None else f"{run['error']:.1e}"
        astray = "" if run["astray"] is None else f"{run['astray']:.1e}"
        cost = f"{run['steps']} | {run['evaluations']} | {1e3 * run['seconds']:.1f}"
        lines.append(f"| {run['method']} | {how} | {error} | {astray} | {cost} |")
    return "\n".join([*lines, ""])
