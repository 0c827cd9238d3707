"""The command's parts put together, and its failures turned into a line each and an exit code."""

import gc
import re
import sys
from collections.abc import Sequence
from importlib import import_module
from typing import Annotated, Final

import typer

from jointplay.command_line import key, scene
from jointplay.command_line.exits import Exit, Stopped
from jointplay.command_line.help_form import Command
from jointplay.worker.transient_faults import is_full

COMMANDS: Final = (
    "run",
    "accuracy",
    "calibrate",
    "demo",
    "reproduce",
    "serve",
    "worker",
    "submit",
    "batch",
    "ls",
    "show",
    "cancel",
    "retry",
    "delete",
    "export",
    "certificate",
    "sensitivity",
    "plot",
    "compare",
    "cite",
    "laws",
    "openapi",
    "doctor",
    "verify",
    "chaos",
)
"""In the order of the help; each is the function of this name in the file of this name."""
EXTRAS: Final = {"reproduce": "paper", "chaos": "chaos"}
"""Commands that a package of its own brings, in its file `command`; an extra has its name. Nothing
else knows it, and all works without it."""
ANYTHING: Final = {"allow_extra_args": True, "ignore_unknown_options": True}

application = typer.Typer(
    name="jointplay",
    help="Simulate planar mechanisms whose joints have play.",
    no_args_is_help=True,
    add_completion=True,
    pretty_exceptions_enable=False,
    rich_markup_mode="markdown",
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _tell_version(*, wanted: bool) -> None:
    if wanted:
        from jointplay import __version__

        typer.echo(f"jointplay {__version__}")
        raise typer.Exit


@application.callback()
def _before_any_command(
    version: Annotated[
        bool,
        typer.Option(
            "--version",
            help="Print the version.",
            is_eager=True,
            callback=lambda wanted: _tell_version(wanted=wanted),
        ),
    ] = False,
) -> None:
    """Simulate planar mechanisms whose joints have play."""


def _add(name: str) -> None:
    """Add a command, or, where what an extra brings is not there, one that says so."""
    extra = EXTRAS.get(name)
    module = f"jointplay.command_line.{name}" if extra is None else f"jointplay.{extra}.command"
    try:
        application.command(name, cls=Command)(getattr(import_module(module), name))
    except ModuleNotFoundError as error:
        if extra is None:
            raise
        line = f"`jointplay {name}` needs {error.name}: pip install 'jointplay[{extra}]'"

        @application.command(name, help=f"{line}.", context_settings=ANYTHING)
        def say() -> None:
            raise Stopped(line)


for name in COMMANDS:
    _add(name)
application.add_typer(scene.application, name="scene")
application.add_typer(key.application, name="key")

OBJECTS_BETWEEN_COLLECTIONS = 500_000
"""A command imports and draws: most objects live on, and Python would look at them all, and again,
for a seventh of the time of a short run. That many objects of no more use take some 50 MB."""

EXITS: Final = {
    "Unreachable": Exit.UNREACHABLE,
    "JobCancelled": Exit.CANCELLED,
    "JobFailed": Exit.FAILED,
    "ServiceFailure": Exit.FAILED,
    "WrongSetting": Exit.BAD_INPUT,
    "StartFailed": Exit.FAILED,
    "Unavailable": Exit.FAILED,
    "ClientError": Exit.BAD_INPUT,
    "InvalidInput": Exit.BAD_INPUT,
    "MalformedJson": Exit.BAD_INPUT,
    "NoSuchTable": Exit.BAD_INPUT,
    "NoSuchPart": Exit.BAD_INPUT,
    "UnknownForm": Exit.BAD_INPUT,
    "NotInstalled": Exit.BAD_INPUT,
    "FigureError": Exit.BAD_INPUT,
    "ResultsError": Exit.BAD_INPUT,
    "FileNotFoundError": Exit.BAD_INPUT,
    "FileExistsError": Exit.BAD_INPUT,
    "IsADirectoryError": Exit.BAD_INPUT,
    "NotADirectoryError": Exit.BAD_INPUT,
    "PermissionError": Exit.BAD_INPUT,
    "OSError": Exit.FAILED,
}
"""By class of exception; by its name, so that nothing is loaded only to be compared with."""

SET_VALUE: Final = re.compile(r"(?:/scene)?/parameters/([^/]+)/default")
"""Pointer of a value that `--set` gave, in a scene given whole."""

PLAINLY: Final = {
    "Value error, ": "",
    "Input should be a valid number, .*": "give a number, such as 0.5 or 5e-4.",
    "Input should be a valid integer, .*": "give a whole number.",
    "Input should be a valid datetime or date, .*": "give a time, such as 2026-05-04T08:15.",
    "Input should be (greater|less) than or equal to ": r"give a number \1 than or equal to ",
}
"""Sentences in place of those of pydantic, which reads options for typer, by regular expression."""

COMMANDS_FOR: Final = {
    "GET /v1/jobs": "`jointplay ls`",
    "GET /v1/scenes": "`jointplay scene list`",
    "Authorization: Bearer jp_...": "give it in the variable JOINTPLAY_KEY",
}
"""Commands and variables for the requests and headers that a service's sentences name."""


def run(arguments: list[str] | None = None) -> int:
    """Run one command and return its exit code; what users cause ends in a line each on stderr."""
    gc.set_threshold(OBJECTS_BETWEEN_COLLECTIONS)
    try:
        code = application(arguments, prog_name="jointplay", standalone_mode=False)
    except (KeyboardInterrupt, typer.Abort):
        return _reported(Exit.INTERRUPTED, "interrupted")
    except typer.TyperException as error:
        return _misused(error)
    except Stopped as error:
        return _reported(error.code, _as_typed(str(error)))
    except Exception as error:
        lines = _lines_of(error, sys.argv[1:] if arguments is None else arguments)
        code = _exit_of(error)
        if not lines or code is None:
            raise  # a fault of ours: the traceback is what helps
        return _reported(code, *lines)
    if code == Exit.INTERRUPTED:  # typer's own way to say Ctrl-C
        return _reported(Exit.INTERRUPTED, "interrupted")
    return int(code or Exit.OK)


def _misused(error: typer.TyperException) -> int:
    """Say what is wrong with what was typed; nothing of a group alone, whose help was told."""
    why = error.format_message()
    for theirs, ours in PLAINLY.items():
        why = re.sub(theirs, ours, why)
    context = getattr(error, "ctx", None)
    command = "jointplay" if context is None else context.command_path
    return _reported(Exit.BAD_INPUT, f"{why} (see: {command} --help)") if why else Exit.OK


def _reported(code: Exit, *lines: str) -> int:
    for line in lines:
        sys.stderr.write(f"jointplay: {' '.join(line.split())}\n")
    return code


def _exit_of(error: Exception) -> Exit | None:
    for kind in type(error).__mro__:
        ours = kind.__module__ == "builtins" or kind.__module__.startswith("jointplay.")
        if ours and kind.__name__ in EXITS:
            return EXITS[kind.__name__]
    return None


def _lines_of(error: Exception, arguments: Sequence[str] = ()) -> list[str]:
    """Return what is said of a failure; nothing where the system failed without naming a file."""
    if isinstance(error, OSError) and error.errno is not None:
        if is_full(error):
            return [f"{error.filename or 'a disk'} is full; make room and try again."]
        return [] if error.filename is None else [f"{error.filename}: {error.strerror}."]
    kinds = ("problems", "flaws", "fields")
    problems = next((found for kind in kinds if (found := getattr(error, kind, ()))), ())
    typed = [(_option_of(pointer, arguments), detail) for pointer, detail in problems]
    listed = [f"{pointer}: {detail}" if pointer else detail for pointer, detail in typed]
    return [_as_typed(line) for line in listed or [str(error)]]


def _option_of(pointer: str, arguments: Sequence[str]) -> str:
    """Return the option by which a refused value was typed; where none was, its pointer."""
    found = SET_VALUE.fullmatch(pointer)
    typed = " ".join(arguments).replace("--set=", "--set ")
    return f"--set {found[1]}" if found and f"--set {found[1]}=" in typed else pointer


def _as_typed(line: str) -> str:
    """Return a sentence with commands in place of requests."""
    for request, command in COMMANDS_FOR.items():
        line = line.replace(request, command)
    return line
