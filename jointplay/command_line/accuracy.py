"""``jointplay accuracy``: what every method and tolerance costs and buys on one scene."""

import json
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from jointplay.command_line import job_document
from jointplay.command_line.exits import Exit, Stopped
from jointplay.command_line.json_output import AS_JSON, print_json

if TYPE_CHECKING:
    from jointplay.command_line.drawing import Form
    from solver.admission import Admission
    from solver.trade.measure import Trade


def accuracy(
    source: job_document.JOB,
    settings: job_document.SET = None,
    duration: job_document.DURATION = None,
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
) -> None:
    """Measure what every method and tolerance costs and buys on a scene, and recommend one.

    Each is run over the duration, by default one period of the drivers, and compared with a
    reference run for as long as that is known. It takes up to a minute.

    Example: `jointplay accuracy seven-bar-press --set clearance=3e-4 -o trade.svg`
    """
    from jointplay.progress import progress
    from solver.trade.advice import advice

    if output is not None and output.suffix not in (".png", ".svg", ".json"):
        raise Stopped(Exit.BAD_INPUT, f"{output}: the name ends in .png, .svg or .json.")
    admission = _admission(source, settings or [], duration)
    with progress("accuracy") as report:
        from solver.trade.measure import measure

        trade = measure(admission, report)
    sentence = advice(trade)
    document = trade.document() | {"advice": sentence}
    if output is not None:
        _write(output, trade, document)
    if as_json:
        print_json(document)
        return
    typer.echo(table(trade))
    typer.echo(sentence)


def _admission(source: str, settings: list[str], duration: float | None) -> "Admission":
    from solver.admission import Study, admit
    from solver.assembly import assemble
    from solver.scene.document import Scene

    document = job_document.job_document(source, settings=settings, options={"duration": duration})
    document.setdefault("duration", 1.0)
    admission = admit(document)
    if isinstance(admission, Study):
        raise Stopped(Exit.BAD_INPUT, f"{source} is a {admission.kind}; give one simulation.")
    if assemble(Scene.model_validate(admission.scene)).freedom_with_play == 0:
        raise Stopped(
            Exit.BAD_INPUT,
            "Drivers prescribe every motion of this scene: nothing is integrated. Give it"
            " clearance.",
        )
    if duration is None and admission.period is not None:
        again = admit(document | {"duration": admission.period})
        assert not isinstance(again, Study)  # noqa: S101  (the same document; narrows the type)
        return again
    return admission


def _write(output: Path, trade: "Trade", document: dict[str, Any]) -> None:
    if output.suffix == ".json":
        output.write_text(json.dumps(document, indent=1) + "\n")
        return
    from jointplay.figures.work_precision import Cost, draw_work_precision
    from solver.trade.measure import MOST_ASTRAY

    methods = {
        method: [Cost(p.evaluations, p.error, p.astray, p.admitted) for p in points]
        for method, points in groupby(trade.points, lambda point: point.method)
    }
    form: Form = "svg" if output.suffix == ".svg" else "png"
    output.write_bytes(draw_work_precision(methods, trade.uncertainty, MOST_ASTRAY, form))


def table(trade: "Trade") -> str:
    """Return the study as a table in Markdown, with what the columns mean."""
    lines = [
        f"Error: root mean square over the first {trade.window:.3g} s, in which the reference is"
        f" known to {trade.uncertainty:.0e}, relative to the scene's scales.",
        f"Cost and energy astray, as a share of what contacts and friction take: of"
        f" {trade.duration:.3g} s.",
        "",
        "| method | tolerance or step | error | energy astray | steps | evaluations | ms |",
        "|---|---|---|---|---|---|---|",
    ]
    for p in trade.points:
        how = f"{p.tolerance:.0e}" if p.tolerance else f"{p.step:.2g} s"
        how += "" if p.admitted else " (refused)"
        error = "fails" if p.error is None else f"{p.error:.1e}"
        astray = "" if p.astray is None else f"{p.astray:.1e}"
        cost = f"{p.steps} | {p.evaluations} | {1e3 * p.seconds:.1f}"
        lines.append(f"| {p.method} | {how} | {error} | {astray} | {cost} |")
    return "\n".join([*lines, ""])
