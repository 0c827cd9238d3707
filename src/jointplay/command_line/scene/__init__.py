"""``jointplay scene``: mechanisms, the presets and one's own."""

import typer

from jointplay.command_line.scene import check, draw, presets, schema

application = typer.Typer(
    help="Look at mechanisms: the presets, and scene documents of your own.",
    no_args_is_help=True,
    rich_markup_mode="markdown",
)
application.command("list")(presets.list_presets)
application.command("show")(presets.show)
application.command("check")(check.check)
application.command("draw")(draw.draw)
application.command("schema")(schema.schema)
