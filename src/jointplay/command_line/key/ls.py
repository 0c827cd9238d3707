"""``jointplay key ls``: the keys of a service."""

from jointplay.command_line.key.catalogue import DATA, HERE, catalogue_at, shown
from jointplay.command_line.options import AS_JSON
from jointplay.command_line.output import aligned, print_result


def ls(data: DATA = HERE, as_json: AS_JSON = False) -> None:
    """List all keys, oldest first: whose they are, what for, until when, and when last used.

    Example: `jointplay key ls --data results`
    """
    with catalogue_at(data) as catalogue:
        keys = [shown(key) for key in catalogue.all_keys()]
    rows = [("id", "owner", "scopes", "expires", "revoked", "last used", "note")]
    rows += [
        (
            key["id"],
            key["owner"],
            " ".join(key["scopes"]),
            *(key[name] or "-" for name in ("expires", "revoked", "last_used")),
            key["note"],
        )
        for key in keys
    ]
    print_result({"keys": keys}, aligned(rows), as_json=as_json)
