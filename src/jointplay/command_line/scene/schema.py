"""``jointplay scene schema``: what a scene document may hold, for editors and programs."""

from pathlib import Path
from typing import Annotated

import typer

from jointplay.command_line.options import AS_JSON
from jointplay.command_line.output import print_result
from jointplay.records.whole_file import write_whole


def schema(
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="FILE", help="Default: print it.")
    ] = None,
    as_json: AS_JSON = False,
) -> None:
    """Print the JSON Schema of a scene: every field with its type, range and unit.

    A service has the same at /v1/schemas/scene.json.

    Example: `jointplay scene schema -o scene.schema.json`
    """
    import json

    from jointplay.solver.scene.schema import scene_schema

    document = scene_schema()
    text = json.dumps(document, indent=2)
    if output is not None:
        write_whole(output, text + "\n")
    print_result(document, [text if output is None else output], as_json=as_json)
