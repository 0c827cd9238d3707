"""``jointplay scene draw``: a mechanism in its starting position, to look at."""

from pathlib import Path
from typing import Annotated

import typer

from jointplay.command_line import job_document
from jointplay.command_line.drawing import Form
from jointplay.command_line.exits import Exit, Stopped
from jointplay.command_line.output import AS_JSON, print_json
from jointplay.command_line.scene.assembled import SCENE, assemble_scene


def draw(
    source: Annotated[str, SCENE],
    settings: job_document.SET = None,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", metavar="FILE", help="A .png or .svg; default NAME.png."),
    ] = None,
    as_json: AS_JSON = False,
) -> None:
    """Draw a mechanism as it stands at t = 0.

    One that does not close, or cannot be run for another reason, is drawn as far as it was put
    together; the reason stands beside it.

    Example: `jointplay scene draw mine.json -o mine.svg`
    """
    from jointplay import figures

    scene = assemble_scene(source, settings or ())
    file = output or Path(f"{scene.document['name']}.png")
    if file.suffix not in {".png", ".svg"}:
        raise Stopped(Exit.BAD_INPUT, f"-o {file}: name a file that ends in .png or .svg.")
    form: Form = "svg" if file.suffix == ".svg" else "png"
    file.write_bytes(figures.render_mechanism(scene.document, scene.pose(), form))
    if as_json:
        problems = [] if scene.refusal is None else list(scene.refusal.problems)
        print_json({"figure": str(file), "problems": problems})
    else:
        typer.echo(file)
    if scene.refusal is not None:
        typer.echo(f"jointplay: drawn, but it cannot be run. {scene.refusal}", err=True)
