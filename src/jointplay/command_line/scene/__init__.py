"""``jointplay scene``: mechanisms, the presets and one's own."""

import typer

from jointplay.command_line.help_form import Command
from jointplay.command_line.scene import check, draw, presets, schema

application = typer.Typer(
    help="Look at mechanisms: the presets, and scene documents of your own.",
    no_args_is_help=True,
    rich_markup_mode="markdown",
)
application.command("list", cls=Command)(presets.list_presets)
application.command("show", cls=Command)(presets.show)
application.command("check", cls=Command)(check.check)
application.command("draw", cls=Command)(draw.draw)
application.command("schema", cls=Command)(schema.schema)
