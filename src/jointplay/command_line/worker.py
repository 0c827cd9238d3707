"""``jointplay worker``: compute blocks for a service, from its settings or over HTTPS alone."""

import sys
from datetime import datetime
from pathlib import Path
from typing import Annotated

import typer

from jointplay.command_line.exits import Stopped
from jointplay.command_line.options import AS_JSON
from jointplay.command_line.output import print_result, remark

_MARGIN = 30.0  # s for a restart point to be stored and sent
_DATE = 8
"""Digits of a date without dashes; a time in epoch seconds has more."""

JOIN = Annotated[
    str | None,
    typer.Option(
        metavar="URL",
        envvar="JOINTPLAY_URL",
        help="Address of a service, for a worker that has nothing else; without it the worker"
        " needs catalogue, Redis and results.",
    ),
]
SETTINGS = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE",
        envvar="JOINTPLAY_SETTINGS",
        help="Lines such as JOINTPLAY_REDIS_URL=redis://HOST, beside the variables.",
    ),
]
KEY_FILE = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE",
        help="Holds a key with the scope worker; else JOINTPLAY_KEY, or none.",
    ),
]
IDLE = Annotated[
    float | None,
    typer.Option(min=0.0, metavar="SECONDS", help="End after this long without work."),
]
UNTIL = Annotated[
    str | None,
    typer.Option(
        metavar="TIME",
        help="Give back what is computed half a minute before: 2026-11-23T18:00, or seconds"
        " since 1970.",
    ),
]
PROCESSES = Annotated[
    int, typer.Option(min=1, max=1024, metavar="N", help="Blocks at a time, a core each.")
]
DEVICE = Annotated[
    str | None,
    typer.Option(metavar="cpu|auto|cuda:N", help="For points of studies: JOINTPLAY_DEVICE."),
]


def worker(
    join: JOIN = None,
    settings: SETTINGS = None,
    key_file: KEY_FILE = None,
    idle: IDLE = None,
    until: UNTIL = None,
    processes: PROCESSES = 1,
    device: DEVICE = None,
    as_json: AS_JSON = False,
) -> None:
    """Compute blocks for a service: one of whose machines this is, or one elsewhere.

    With --join it needs the address of that service and a key, and no other access. Without it the
    worker is one that `jointplay serve` would start, with JOINTPLAY_CATALOGUE_URL,
    JOINTPLAY_RESULTS_URL and JOINTPLAY_REDIS_URL of the environment, or of a file.

    Uses one core for each process. SIGTERM and Ctrl-C give back what is being computed, with a
    restart point, and end it.  With --device a graphics processor computes the points of studies,
    many blocks at a time.

    Example: `jointplay worker --join https://lab.example.org --key-file worker.key --idle 300`
    """
    import os

    from jointplay.records.log_lines import begin
    from jointplay.service.processes.supervisor import settings_of
    from jointplay.storage.settings import Settings
    from jointplay.storage.settings_files import mistyped_variables
    from jointplay.worker.holding import Refused
    from jointplay.worker.joined.connection import key_in
    from jointplay.worker.joined.processes import work_in

    if settings is not None:
        os.environ["JOINTPLAY_SETTINGS"] = str(settings.absolute())
    if device is not None:
        os.environ["JOINTPLAY_DEVICE"] = device
    found = settings_of()
    remark(mistyped_variables(Settings))
    if join is None:
        if key_file is not None or idle is not None or until is not None:
            raise Stopped("--key-file, --idle and --until are for a worker with --join.")
        if found.redis_url is None:
            raise Stopped("--join URL is missing, or JOINTPLAY_REDIS_URL, such as redis://HOST.")
        module = ["-m", "jointplay.worker", "--processes", str(processes)]
        os.execv(sys.executable, [sys.executable, "-P", *module])  # noqa: S606 - no shell is wanted
    begin(found.log_format)
    end = None if until is None else _moment(until) - _MARGIN
    try:
        key = os.environ.get("JOINTPLAY_KEY") if key_file is None else key_in(key_file)
        blocks = work_in(processes, join, key, idle, end, found.device)
    except Refused as refused:
        raise Stopped(f"{refused}.") from refused
    print_result({"url": join, "blocks": blocks}, [f"computed {blocks} blocks"], as_json=as_json)


def _moment(text: str) -> float:
    """Return epoch seconds of a time, local where it names no zone."""
    try:
        is_epoch = text.isdecimal() and len(text) > _DATE
        return float(text) if is_epoch else datetime.fromisoformat(text).timestamp()
    except (ValueError, OverflowError) as error:
        line = f"--until is {text!r}; it must be a time such as 2026-11-23T18:00."
        raise Stopped(line) from error
