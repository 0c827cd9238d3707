"""``jointplay laws``: the laws of contact, friction and force, and the functions, of scenes."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated

import typer

from jointplay.command_line.options import AS_JSON
from jointplay.command_line.output import aligned, print_result

if TYPE_CHECKING:
    from jointplay.solver.laws.catalogue import Law, LawParameter


def laws(
    name: Annotated[
        str | None,
        typer.Argument(metavar="[NAME]", help="A law, or one of the families of laws."),
    ] = None,
    as_json: AS_JSON = False,
) -> None:
    """List the laws of contact, friction and force, and the functions; or show one of them.

    Examples: `jointplay laws johnson`, `jointplay laws function`
    """
    from jointplay.solver.laws import catalogue

    found = catalogue.laws(name)
    print_result(
        {"laws": [law.model_dump() for law in found]}, _lines(found, name), as_json=as_json
    )


def _lines(found: "list[Law]", name: str | None) -> Iterator[str]:
    """Yield the list of all laws or of a family, and the pages of laws of that name."""
    from jointplay.solver.laws import catalogue

    if name is None or name in catalogue.FAMILIES:
        yield from _list(found)
    for law in found:
        if law.name == name:
            yield from _page(law)


def _list(found: "list[Law]") -> Iterator[str]:
    yield from aligned([(law.family, law.name, law.formula) for law in found])


def _page(law: "Law") -> Iterator[str]:
    import textwrap

    yield f"{law.name} ({law.family}): {law.formula}"
    for text in (law.text, law.assumes, law.fails, f"Source: {law.source}"):
        yield textwrap.fill(text, 88, initial_indent="  ", subsequent_indent="  ")
    if law.parameters:
        yield from aligned([_row(parameter) for parameter in law.parameters])
    if law.restitution is not None:
        asked, delivered = law.restitution.asked, law.restitution.delivered
        yield from aligned(
            [
                ("  restitution asked", *(f"{e:g}" for e in asked)),
                ("  delivered", *(f"{e:.4f}" for e in delivered)),
            ]
        )


def _row(parameter: "LawParameter") -> tuple[str, ...]:
    low = f"> {parameter.above:g}" if parameter.above is not None else ""
    low = f">= {parameter.minimum:g}" if parameter.minimum is not None else low
    high = f"< {parameter.below:g}" if parameter.below is not None else ""
    high = f"<= {parameter.maximum:g}" if parameter.maximum is not None else high
    allowed = " or ".join(parameter.choices or ()) or ", ".join(filter(None, (low, high)))
    default = "required" if parameter.required else f"default {parameter.default}"
    return (f"  {parameter.name}", parameter.unit, default, allowed, parameter.help)
