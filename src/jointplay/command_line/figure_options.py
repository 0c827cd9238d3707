"""Options of a figure's page, as `jointplay.figures` describes them."""

from collections.abc import Callable, Mapping
from inspect import Parameter, signature
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeVar

import typer

from jointplay.command_line.exits import Stopped
from jointplay.records.figure_form import FORMS, Form
from jointplay.records.page_option import OPTIONS, Option

if TYPE_CHECKING:
    from jointplay.figures import Options

Command = TypeVar("Command", bound=Callable[..., Any])
SHOWN = ("channels", "joints", "start", "stop", "over", *OPTIONS)
"""Names of the options that say what a figure shows, and how."""
_METAVARS = {"mm": "MM", "pt": "POINTS", "": "VALUE"}


def form_of(path: Path, *others: str) -> Form:
    """Return the form of a figure by the name of its file; it may have `others`, too."""
    for form in FORMS:
        if path.suffix == f".{form}":
            return form
    *endings, last = [*(f".{form}" for form in FORMS), *others]
    raise Stopped(f"{path}: the name ends in {', '.join(endings)} or {last}.")


def with_figure_options(command: Command) -> Command:
    """Give a command the options of a figure's page in place of its ``**options``."""
    own = [p for p in signature(command).parameters.values() if p.kind != p.VAR_KEYWORD]
    added = [
        Parameter(name, Parameter.KEYWORD_ONLY, default=None, annotation=_option(option))
        for name, option in OPTIONS.items()
    ]
    both = [*(one.replace(kind=Parameter.KEYWORD_ONLY) for one in own), *added]
    shown: Any = command
    shown.__signature__ = signature(command).replace(parameters=both)
    shown.__annotations__ = {one.name: one.annotation for one in both}
    return command


def page_of(options: Mapping[str, Any]) -> "Options":
    """Return the options that were typed; what cannot be stops the command."""
    from jointplay.figures import NotDrawable, chosen_options

    try:
        return chosen_options(options)
    except NotDrawable as error:
        raise Stopped(f"--{error.cause.replace('_', '-')}: {error}") from None


def _option(option: Option) -> Any:
    text = f"{option.help}."
    if option.choices:
        return Annotated[Literal[option.choices] | None, typer.Option(help=text)]
    kind = str if option.is_text else float
    metavar = "TEXT" if option.is_text else _METAVARS[option.unit]
    return Annotated[kind | None, typer.Option(metavar=metavar, help=text)]
