"""``jointplay openapi``: the description of the HTTP interface, without a service."""

from pathlib import Path
from typing import Annotated

import typer

from jointplay.records.whole_file import write_whole


def openapi(
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="FILE", help="Default: print it.")
    ] = None,
) -> None:
    """Print the OpenAPI document that a service has at /openapi.json.

    Example: `jointplay openapi -o openapi.json`
    """
    import json

    from jointplay.service.app import create_app

    text = json.dumps(create_app().openapi(), indent=2, sort_keys=True)
    if output is not None:
        write_whole(output, text + "\n")
    typer.echo(text if output is None else output)
