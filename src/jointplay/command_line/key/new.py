"""``jointplay key new``: a key for somebody."""

from typing import Annotated

import typer

from jointplay.command_line.exits import Stopped
from jointplay.command_line.key.catalogue import DATA, HERE, catalogue_at, shown
from jointplay.command_line.options import AS_JSON
from jointplay.command_line.output import print_result


def new(
    owner: Annotated[
        str, typer.Option(metavar="NAME", help="Whose it is; an owner sees only their own jobs.")
    ],
    scopes: Annotated[
        list[str] | None,
        typer.Option(
            "--scope",
            metavar="SCOPE",
            help="jobs:write, jobs:read, results:read, worker, metrics or admin; repeatable, by"
            " default the first three.",
        ),
    ] = None,
    days: Annotated[
        float | None, typer.Option(min=0.0, max=36500.0, help="How long it opens; else for ever.")
    ] = None,
    note: Annotated[str, typer.Option(help="What it is for, for `jointplay key ls`.")] = "",
    data: DATA = HERE,
    as_json: AS_JSON = False,
) -> None:
    """Make a key and print it; it is shown this once, and only its digest is kept.

    Example: `jointplay key new --owner ada --days 90 --note laptop --data results`
    """
    if len(note) > 200:
        raise Stopped("--note has at most 200 characters.")
    if days == 0.0:
        raise Stopped(
            "--days 0 is a key that opens nothing; leave it out for one that opens for ever."
        )
    with catalogue_at(data) as catalogue:
        wanted = scopes or ["jobs:write", "jobs:read", "results:read"]
        try:
            text, key = catalogue.make_key(
                owner, wanted, note, None if days is None else 86_400.0 * days
            )
        except ValueError as error:
            raise Stopped(f"{error}.") from error
    print_result(shown(key) | {"key": text}, [text], as_json=as_json)
