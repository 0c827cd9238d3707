"""``jointplay serve``: the whole service on this machine."""

from pathlib import Path
from typing import Annotated

import typer

from jointplay.command_line.output import remark


def serve(
    host: Annotated[str, typer.Option(help="Address to listen at.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(min=0, max=65535, help="0 takes a free port.")] = 8000,
    data: Annotated[
        Path | None,
        typer.Option(
            metavar="FOLDER",
            help="Where catalogue and results are kept; by default JOINTPLAY_DATA, or .jointplay.",
        ),
    ] = None,
    workers: Annotated[
        int,
        typer.Option(
            min=0,
            max=256,
            help="How many jobs are computed at a time here; 0: only by workers that join.",
        ),
    ] = 2,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print address and data as JSON once it answers.")
    ] = False,
) -> None:
    """Keep the service up: broker, API, relay and workers under one supervisor.

    Ctrl-C or SIGTERM ends it cleanly; running jobs go on from where they were when it is started
    again with the same data.

    Example: `jointplay serve --port 8000 --data results --workers 4`
    """
    from jointplay.service.processes import serve as keep_serving
    from jointplay.service.processes.supervisor import settings_of
    from jointplay.storage.settings import Settings
    from jointplay.storage.settings_files import mistyped_variables

    remark(mistyped_variables(Settings))
    keep_serving(host, port, settings_of(data).data, workers, as_json=as_json)
