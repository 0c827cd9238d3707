"""``jointplay key``: who may ask a service that others can reach."""

import typer

from jointplay.command_line.help_form import Command
from jointplay.command_line.key import ls, new, revoke

application = typer.Typer(
    help="Make and revoke keys of a service, where its data is.",
    no_args_is_help=True,
    rich_markup_mode="markdown",
)
application.command("new", cls=Command)(new.new)
application.command("ls", cls=Command)(ls.ls)
application.command("revoke", cls=Command)(revoke.revoke)
