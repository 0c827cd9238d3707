"""``jointplay worker``: compute blocks for a service elsewhere, over HTTPS alone."""

import signal
import threading
import time
from datetime import datetime
from pathlib import Path
from typing import Annotated

import typer

from jointplay.command_line.exits import Stopped
from jointplay.command_line.options import AS_JSON
from jointplay.command_line.output import tell

_MARGIN = 30.0  # s for a restart point to be stored and sent


def worker(
    join: Annotated[
        str, typer.Option(metavar="URL", envvar="JOINTPLAY_URL", help="Address of the service.")
    ],
    key_file: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Holds a key with the scope worker; else JOINTPLAY_KEY, or none.",
        ),
    ] = None,
    idle: Annotated[
        float | None,
        typer.Option(min=0.0, metavar="SECONDS", help="End after this long without work."),
    ] = None,
    until: Annotated[
        str | None,
        typer.Option(
            metavar="TIME",
            help="Give back what is computed half a minute before: 2026-11-23T18:00, or seconds"
            " since 1970.",
        ),
    ] = None,
    as_json: AS_JSON = False,
) -> None:
    """Compute blocks for a service elsewhere; needs its address and a key, and no other access.

    Uses one core; start it once for each. SIGTERM and Ctrl-C give back what is being computed, with
    a restart point, and end it.

    Example: `jointplay worker --join https://lab.example.org --key-file worker.key --idle 300`
    """
    import logging
    import os

    from jointplay.records.log_lines import begin
    from jointplay.storage.settings import Settings
    from jointplay.worker.joined.connection import Connection, Refused, key_in
    from jointplay.worker.joined.loop import work

    begin(Settings().log_format)
    logging.getLogger("httpx").setLevel(logging.WARNING)
    draining = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: draining.set())
    if until is not None:
        timer = threading.Timer(max(_moment(until) - _MARGIN - time.time(), 0.0), draining.set)
        timer.daemon = True
        timer.start()
    try:
        key = os.environ.get("JOINTPLAY_KEY") if key_file is None else key_in(key_file)
        connection = Connection(join, key)
        try:
            blocks = work(connection, draining, idle)
        finally:
            connection.close()
    except Refused as refused:
        raise Stopped(f"{refused}.") from refused
    tell({"url": join, "blocks": blocks}, [f"computed {blocks} blocks"], as_json=as_json)


def _moment(text: str) -> float:
    """Return epoch seconds of a time, local where it names no zone."""
    try:
        return float(text) if text.isdigit() else datetime.fromisoformat(text).timestamp()
    except (ValueError, OverflowError) as error:
        line = f"--until is {text!r}; it must be a time such as 2026-11-23T18:00."
        raise Stopped(line) from error
