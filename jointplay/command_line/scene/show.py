"""``jointplay scene show``: a preset's parameters, or its whole document."""

from typing import Annotated

import typer

from jointplay.command_line.output import print_json


def show(
    name: Annotated[str, typer.Argument(metavar="PRESET", help="Name of a preset.")],
    document: Annotated[
        bool, typer.Option("--json", help="Print the scene document: a start for your own.")
    ] = False,
) -> None:
    """Show a preset: what it is, and every parameter with default, unit and meaning.

    Example: `jointplay scene show slider-crank --json > mine.json`
    """
    from jointplay.solver.scene import presets

    scene = presets.document(name, pointer="PRESET")
    if document:
        print_json(scene)
        return
    typer.echo(f"{scene['name']}: {scene['description']}")
    typer.echo(f"source: {scene.get('source') or 'none'}")
    for parameter, declared in scene.get("parameters", {}).items():
        default = declared.get("default")
        shown = "none" if default is None else f"{default} {declared.get('unit', '1')}"
        inferred = " (inferred)" if declared.get("inferred") else ""
        typer.echo(f"  {parameter:18} {shown}{inferred}: {declared['help']}")
