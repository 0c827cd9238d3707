"""``jointplay scene list``: the presets."""

import textwrap

import typer

from jointplay.command_line.output import AS_JSON, print_json


def list_scenes(as_json: AS_JSON = False) -> None:
    """List the preset mechanisms with one paragraph on each.

    Example: `jointplay scene list`
    """
    from jointplay.solver.scene import presets

    if as_json:
        documents = (presets.document(name) for name in presets.names())
        wanted = ("name", "description", "source", "parameters")
        print_json({"scenes": [{key: one.get(key) for key in wanted} for one in documents]})
        return
    for name in presets.names():
        typer.echo(name)
        description = presets.document(name)["description"]
        typer.echo(textwrap.fill(description, 88, initial_indent="  ", subsequent_indent="  "))
