"""``jointplay scene draw``: a mechanism in its starting position, to look at."""

from pathlib import Path
from typing import Annotated, Any

import typer

from jointplay.command_line.exits import Stopped
from jointplay.command_line.figure_options import form_of, page_of, with_figure_options
from jointplay.command_line.options import AS_JSON, SCENE, SET
from jointplay.command_line.output import print_result, remark
from jointplay.command_line.scene.assembled import assemble_scene
from jointplay.records.whole_file import write_whole


@with_figure_options
def draw(
    source: SCENE,
    settings: SET = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "-o", "--output", metavar="FILE", help="A .png, .svg, .pdf, .eps; default NAME.png."
        ),
    ] = None,
    as_json: AS_JSON = False,
    **options: Any,
) -> None:
    """Draw a mechanism as it stands at t = 0.

    One that does not close, or cannot be run for another reason, is drawn as far as it was put
    together; the reason stands beside it.

    Example: `jointplay scene draw mine.json -o mine.svg`
    """
    from jointplay import figures

    scene = assemble_scene(source, settings or ())
    file = output or Path(f"{scene.document['name']}.png")
    form, page = form_of(file), page_of(options)
    try:
        picture = figures.render_mechanism(scene.drawn(), scene.pose(), form, page)
    except figures.NotDrawable as error:
        raise Stopped(str(error)) from None
    write_whole(file, picture)
    print_result({"figure": str(file), "problems": scene.problems}, [file], as_json=as_json)
    if scene.refusal is not None:
        remark([f"drawn, but it cannot be run. {scene.refusal}"])
