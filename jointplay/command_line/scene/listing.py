"""``jointplay scene list``: the presets."""

import textwrap

import typer


def list_scenes() -> None:
    """List the preset mechanisms with one paragraph on each.

    Example: `jointplay scene list`
    """
    from solver import presets

    for name in presets.names():
        typer.echo(name)
        description = presets.document(name)["description"]
        typer.echo(textwrap.fill(description, 88, initial_indent="  ", subsequent_indent="  "))
