"""The command's parts put together, and its failures turned into one line and an exit code."""

import gc
import sys

import typer

from jointplay.command_line import (
    accuracy,
    batch,
    calibrate,
    cancel,
    certificate,
    cite,
    compare,
    delete,
    demo,
    export,
    ls,
    openapi,
    plot,
    reproduce,
    run_locally,
    scene,
    serve,
    show,
    submit,
)
from jointplay.command_line.exits import Exit, Stopped

application = typer.Typer(
    name="jointplay",
    help="Simulate planar mechanisms whose joints have play.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode="markdown",
    context_settings={"help_option_names": ["-h", "--help"]},
)
application.command("run")(run_locally.run)
application.command()(accuracy.accuracy)
application.command()(calibrate.calibrate)
application.command()(demo.demo)
application.command()(reproduce.reproduce)
application.command()(serve.serve)
application.command()(submit.submit)
application.command()(batch.batch)
application.command()(ls.ls)
application.command()(show.show)
application.command()(cancel.cancel)
application.command()(delete.delete)
application.command()(export.export)
application.command()(certificate.certificate)
application.command()(plot.plot)
application.command()(compare.compare)
application.command()(cite.cite)
application.command()(openapi.openapi)
application.add_typer(scene.application, name="scene")

OBJECTS_BETWEEN_COLLECTIONS = 500_000
"""A command imports and draws: most objects live on, and Python would look at them all, and again,
for a seventh of the time of a short run. That many objects of no more use take some 50 MB."""

_WRONG_PATH = (
    FileNotFoundError,
    FileExistsError,
    IsADirectoryError,
    NotADirectoryError,
    PermissionError,
)


def run(arguments: list[str] | None = None) -> int:
    """Run one command and return its exit code; what users cause ends in one line on stderr."""
    gc.set_threshold(OBJECTS_BETWEEN_COLLECTIONS)
    try:
        code = application(arguments, prog_name="jointplay", standalone_mode=False)
    except (KeyboardInterrupt, typer.Abort):
        return _reported(Exit.INTERRUPTED, "interrupted")
    except typer.TyperException as error:
        return _reported(Exit.BAD_INPUT, f"{error.format_message()} (see: jointplay --help)")
    except Exception as error:
        classified = _classified(error)
        if classified is None:
            raise  # a fault of ours: the traceback is what helps
        return _reported(*classified)
    if code == Exit.INTERRUPTED:  # typer's own way to say Ctrl-C
        return _reported(Exit.INTERRUPTED, "interrupted")
    return int(code or Exit.OK)


def _reported(code: Exit, line: str) -> int:
    sys.stderr.write(f"jointplay: {' '.join(line.split())}\n")
    return code


def _classified(error: Exception) -> tuple[Exit, str] | None:
    """Return exit code and line of a failure that is not a fault of the program."""
    if isinstance(error, Stopped):
        return error.code, str(error)
    if isinstance(error, OSError) and error.filename is not None:
        code = Exit.BAD_INPUT if isinstance(error, _WRONG_PATH) else Exit.FAILED
        return code, f"{error.filename}: {error.strerror}."
    return _bad_document(error) or _service_failure(error) or _bad_results(error)


def _bad_document(error: Exception) -> tuple[Exit, str] | None:
    from jointplay.records.failure import InvalidInput
    from jointplay.records.strict_json import MalformedJson

    if isinstance(error, InvalidInput):
        return Exit.BAD_INPUT, _listed(error.problems)
    if isinstance(error, MalformedJson):
        return Exit.BAD_INPUT, _listed(error.flaws)
    return None


def _service_failure(error: Exception) -> tuple[Exit, str] | None:
    from jointplay.client import ClientError, JobCancelled, JobFailed, ServiceFailure, Unreachable
    from jointplay.service.processes import StartFailed, WrongSetting

    if isinstance(error, Unreachable):
        return Exit.UNREACHABLE, str(error)
    if isinstance(error, JobCancelled):
        return Exit.CANCELLED, str(error)
    if isinstance(error, JobFailed | ServiceFailure | StartFailed) and not isinstance(
        error, WrongSetting
    ):
        return Exit.FAILED, str(error)
    known = isinstance(error, ClientError | WrongSetting)
    return (Exit.BAD_INPUT, str(error)) if known else None


def _bad_results(error: Exception) -> tuple[Exit, str] | None:
    from jointplay.figures import FigureError
    from jointplay.storage.results import ResultsError

    known = isinstance(error, FigureError | ResultsError)
    return (Exit.BAD_INPUT, str(error)) if known else None


def _listed(problems: tuple[tuple[str, str], ...]) -> str:
    return "; ".join(f"{place}: {detail}" if place else detail for place, detail in problems)
