"""``jointplay key revoke``: a key that opens nothing any more."""

from typing import Annotated

import typer

from jointplay.command_line.exits import Stopped
from jointplay.command_line.key.catalogue import DATA, HERE, catalogue_at, shown
from jointplay.command_line.options import AS_JSON
from jointplay.command_line.output import print_result


def revoke(
    key_id: Annotated[str, typer.Argument(metavar="ID", help="As `jointplay key ls` has it.")],
    data: DATA = HERE,
    as_json: AS_JSON = False,
) -> None:
    """Revoke a key; a service that runs notices within ten seconds.

    Example: `jointplay key revoke 0f3b21c7 --data results`
    """
    from jointplay.storage.catalogue.errors import KeyNotFound

    with catalogue_at(data) as catalogue:
        try:
            key = catalogue.revoke_key(key_id)
        except KeyNotFound as error:
            line = f"T{str(error)[1:]}; jointplay key ls lists them."
            raise Stopped(line) from error
    print_result(shown(key), [f"{key.id}  revoked"], as_json=as_json)
