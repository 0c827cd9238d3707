"""Arguments and options that several commands have, and the jobs and services that they mean."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from jointplay.command_line.exits import Exit, Stopped

if TYPE_CHECKING:
    from jointplay.client import Client, Job

DEFAULT_URL = "http://127.0.0.1:8000"  # jointplay.client's, without loading it
URL = Annotated[
    str,
    typer.Option(
        "--url",
        envvar="JOINTPLAY_URL",
        help="Address of the service; where it asks for a key, JOINTPLAY_KEY has it.",
    ),
]
AS_JSON = Annotated[bool, typer.Option("--json", help="Print one JSON document instead.")]
WAIT = Annotated[bool, typer.Option("--wait", help="Wait until the job is finished.")]
PROCESSES = Annotated[int | None, typer.Option(min=1, max=1024, help="Default one for each core.")]

JOB_ARGUMENT = typer.Argument(
    metavar="JOB.json|SCENE.json|PRESET",
    help="A job document, a scene document, or the name of a preset (`jointplay scene list`).",
)
JOB = Annotated[str, JOB_ARGUMENT]
SCENE = Annotated[
    str,
    typer.Argument(metavar="SCENE.json|PRESET", help="A scene document, or the name of a preset."),
]
SET = Annotated[
    list[str] | None,
    typer.Option(
        "--set", metavar="NAME=VALUE", help="Set a parameter of the scene, in SI units; repeatable."
    ),
]

RESULTS = Annotated[
    str, typer.Argument(metavar="OUT|ID", help="Folder of `jointplay run`, or id of a job.")
]
START = Annotated[
    float | None, typer.Option(metavar="SECONDS", help="From this time; first point of a study.")
]
STOP = Annotated[
    float | None, typer.Option(metavar="SECONDS", help="To this time; before this point.")
]


LARGEST_WHOLE = 2.0**53
"""Beyond it, numbers with an exponent are not told apart from their neighbours."""


def whole(text: str) -> int:
    """Return a whole number, which may be written 1e3 up to 2^53.

    Raises
    ------
    ValueError
        It is none, as a sentence.
    """
    try:
        return int(text)
    except ValueError:
        pass
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not number.is_integer() or abs(number) > LARGEST_WHOLE:
        raise ValueError(f"{text!r} is not a whole number.")
    return int(number)


def listed(text: str | None) -> list[str] | None:
    """Return the parts of a comma-separated list."""
    return None if text is None else [part.strip() for part in text.split(",")]


def connect(url: str) -> "Client":
    """Return a client of the service at ``url``; nothing is sent yet."""
    from jointplay.client import Client

    return Client(url)


@contextmanager
def job_of(results: str, url: str) -> Iterator["Job"]:
    """Give the job that ``OUT|ID`` means: in a folder, or of the service at ``url``."""
    from jointplay.records.job import is_job_id

    if Path(results).exists() or not is_job_id(results):
        from jointplay.local import load

        yield load(results)
        return
    with connect(url) as client:
        yield client.job(results)


@contextmanager
def refused_as_typed(*names: str) -> Iterator[None]:
    """Say which of these options is refused; a figure's own name needs no word before."""
    from jointplay.client import FieldProblem, Refused

    options = {"name": ""} | {name: f"--{name.replace('_', '-')}" for name in names}
    try:
        yield
    except Refused as error:
        error.fields = tuple(
            FieldProblem(options.get(field, field), detail) for field, detail in error.fields
        )
        raise


def wait_for(job: "Job") -> None:
    """Wait until a job is finished; Ctrl-C stops the waiting, not the job."""
    try:
        job.wait(progress=True, check=False)
    except KeyboardInterrupt:
        line = f"stopped waiting; the job goes on: jointplay show --wait {job.id}"
        raise Stopped(line, Exit.INTERRUPTED) from None
