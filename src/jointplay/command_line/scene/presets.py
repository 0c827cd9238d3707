"""``jointplay scene list`` and ``show``: the presets, their parameters and documents."""

import textwrap
from collections.abc import Iterator
from typing import Annotated, Any

import typer

from jointplay.command_line.options import AS_JSON
from jointplay.command_line.output import print_result


def list_presets(as_json: AS_JSON = False) -> None:
    """List the preset mechanisms with one paragraph on each, and what must be given.

    Example: `jointplay scene list`
    """
    from jointplay.solver.scene import presets

    documents = [presets.document(name) for name in presets.names()]
    wanted = ("name", "description", "source", "parameters")
    lines = (line for one in documents for line in (one["name"], *_about(one)))
    found = [{key: one.get(key) for key in wanted} for one in documents]
    print_result({"scenes": found}, lines, as_json=as_json)


def show(
    name: Annotated[str, typer.Argument(metavar="PRESET", help="Name of a preset.")],
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the scene document: a start for your own.")
    ] = False,
) -> None:
    """Show a preset: what it is, and every parameter with default, unit and meaning.

    Example: `jointplay scene show slider-crank --json > mine.json`
    """
    from jointplay.solver.scene import presets

    scene = presets.document(name, pointer="PRESET")
    print_result(scene, _lines(scene), as_json=as_json)


def _about(scene: dict[str, Any]) -> Iterator[str]:
    yield textwrap.fill(scene["description"], 88, initial_indent="  ", subsequent_indent="  ")
    required = [name for name, one in scene.get("parameters", {}).items() if one.get("required")]
    if required:
        yield f"  To be given: {', '.join(required)}."


def _lines(scene: dict[str, Any]) -> Iterator[str]:
    yield f"{scene['name']}: {scene['description']}"
    yield f"source: {scene.get('source') or 'none'}"
    for parameter, declared in scene.get("parameters", {}).items():
        default = declared.get("default")
        unit = declared.get("unit", "1")
        shown = f"{default} {unit}"
        if default is None:
            shown = f"required, {unit}" if declared.get("required") else "none"
        inferred = " (inferred)" if declared.get("inferred") else ""
        yield f"  {parameter:18} {shown}{inferred}: {declared['help']}"
