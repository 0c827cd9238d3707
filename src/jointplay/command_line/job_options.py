"""Options that are fields of a job: most as the kinds describe them, and short forms of ranges."""

from collections.abc import Callable, Iterable, Mapping
from inspect import Parameter, signature
from typing import Annotated, Any, Final, TypeVar

import typer

from jointplay.command_line.exits import Stopped
from jointplay.command_line.options import listed, whole
from jointplay.job_fields import KINDS, help_of

Command = TypeVar("Command", bound=Callable[..., Any])

_OPTIONS: Final = {name: kind["option"] for name, kind in KINDS.items() if "option" in kind}
"""By kind, the option that asks for it; simulate is what is meant without one."""
_NAMES: Final = {kind: option.get("name", kind) for kind, option in _OPTIONS.items()}
"""Its name."""
_RANGE: Final = "NAME=FROM:TO:COUNT"
_SHORT: Final[dict[str, tuple[Any, str | None, str]]] = {
    "values": (list[str], _RANGE, "; append `:log` for equal ratios."),  # to refuse it twice
    "axis": (list[str], _RANGE, "; append `:log` for equal ratios."),
    "grid": (list[str], _RANGE, "; or NAME=A,B,C; repeat it for every combination."),
    "distributions": (
        list[str],
        "NAME=DISTRIBUTION:A:B",
        ", such as clearance=uniform:1e-4:5e-4; repeat it for every parameter.",
    ),
    "integer": (int, None, "."),
    "flag": (bool, None, "."),
}
"""Type, metavar and end of the help of the option that asks for a kind, by its form."""
_ENDS: Final = {"continuation": "; COUNT is of the orbits that it may have in each direction."}
"""End of the help of a kind whose option reads the same form another way."""
_HELP: Final = {
    "settle": (
        "Leave out what comes before: of a simulation's peaks, in seconds; of a study's sections or"
        " statistics, in periods, or auto."
    ),
    "second": "A second parameter, over which special orbits of the first branch are followed.",
    "seed": "Seed of what is drawn; the same gives the same.",
    "section": (
        "Where: crank_angle=RAD past the start, onset=JOINT, or of a study CHANNEL=VALUE:up (or"
        " down)."
    ),
}
_METAVARS: Final = {"names": "A,B", "numbers": "X,Y", "axis": _RANGE}
_IN_DOCUMENTS: Final = ("flag", "values", "grid", "distributions", "other")
"""Forms of fields that only a document can give."""
_METAVAR_OF: Final = {"settle": "SECONDS|PERIODS"}
_UNITS: Final = {"s": "SECONDS", "periods": "PERIODS"}
_TYPES: Final = {"number": float, "integer": int}


def _fields() -> dict[str, dict[str, Any]]:
    """Return the fields of all kinds; of one that several have, the form that takes any of them."""
    found: dict[str, dict[str, Any]] = {}
    for name, kind in KINDS.items():
        if name not in ("simulate", *_OPTIONS):  # a document: `jointplay calibrate` makes one
            continue
        option = kind.get("option", {}).get("fields", ())
        for field, one in kind["fields"].items():
            if field in option or one["form"] in _IN_DOCUMENTS:
                continue
            seen = found.setdefault(field, one | {"kinds": []})
            seen["kinds"].append(name)
            seen["words"] = list(dict.fromkeys([*seen.get("words", ()), *one.get("words", ())]))
    return found


FIELDS: Final = _fields()


def _short_option(kind: str) -> Any:
    option = _OPTIONS[kind]
    form, metavar, end = _SHORT[option["form"]]
    names = [f"--{_NAMES[kind]}"] if form is bool else []  # without one, typer adds the contrary
    text = KINDS[kind]["help"].removesuffix(".").partition("; ")[0] + _ENDS.get(kind, end)
    metavar = metavar or "".join(option["fields"]).upper() or None
    return _typed(form, *names, metavar=metavar, help=text)


def _typed(kind: Any, *names: str, metavar: str | None, help: str) -> Any:  # noqa: A002  (typer's)
    """Return the type of an option as typer reads it; whole numbers may be written 1e3."""
    if kind is int:
        option = typer.Option(*names, metavar=metavar or "INTEGER", help=help, parser=whole)
    else:
        option = typer.Option(*names, metavar=metavar, help=help)
    return Annotated[kind | None, option]


def _option(name: str) -> Any:
    """Return the type of a field's option, as typer reads it."""
    field = FIELDS[name]
    metavar = _METAVAR_OF.get(name) or _METAVARS.get(field["form"])
    metavar = metavar or _UNITS.get(field.get("unit", ""))
    text = _HELP.get(name) or help_of(field | ({"unit": ""} if metavar else {}), short=True)
    if "simulate" not in field["kinds"]:
        owner = "study" if len(field["kinds"]) > 1 else field["kinds"][0]
        text = f"Of {'an' if owner[0] in 'ae' else 'a'} {owner}: {text[:1].lower()}{text[1:]}"
    kind = str if field["words"] else _TYPES.get(field["form"], str)
    return _typed(kind, metavar=metavar, help=text)


def with_job_options(*only: str) -> Callable[[Command], Command]:
    """Give a command the options of a job, or only these, in place of its ``**options``.

    They come as keywords; `fields_of` makes fields of a job of them.
    """
    chosen = (
        {}
        if only
        else {name.replace("-", "_"): _short_option(kind) for kind, name in _NAMES.items()}
    )
    chosen |= {name: _option(name) for name in (only or FIELDS)}

    def extend(command: Command) -> Command:
        own = [p for p in signature(command).parameters.values() if p.kind != p.VAR_KEYWORD]
        keyword = Parameter.KEYWORD_ONLY
        options = [Parameter(n, keyword, default=None, annotation=a) for n, a in chosen.items()]
        first = [p.replace(kind=keyword) for p in own if p.name in ("source", "output", "settings")]
        last = [p.replace(kind=keyword) for p in own if p.name not in {one.name for one in first}]
        shown: Any = command
        shown.__signature__ = signature(command).replace(parameters=[*first, *options, *last])
        shown.__annotations__ = {p.name: p.annotation for p in (*first, *options, *last)}
        return command

    return extend


def fields_of(options: Mapping[str, Any]) -> dict[str, Any]:
    """Return options as fields of a job, without those that were not given."""
    given = {  # 0 is given, though it equals False
        name: value
        for name, value in options.items()
        if value is not None and value is not False and value != []
    }
    kinds = [kind for kind, name in _NAMES.items() if name.replace("-", "_") in given]
    if len(kinds) > 1:
        raise Stopped(f"--{_NAMES[kinds[0]]} and --{_NAMES[kinds[1]]} are two jobs; give one.")
    found: dict[str, Any] = {"kind": kinds[0]} if kinds else {}
    for kind in kinds:
        found |= _asked(kind, given[_NAMES[kind].replace("-", "_")])
    named = {name: value for name, value in options.items() if name in FIELDS and value is not None}
    return found | {name: _value(name, value) for name, value in named.items()}


def _asked(kind: str, given: Any) -> dict[str, Any]:
    """Return the fields that the option of a kind stands for."""
    option, fields, form = f"--{_NAMES[kind]}", _OPTIONS[kind]["fields"], _OPTIONS[kind]["form"]
    if form == "grid":
        return {fields[0]: once(option, (_values(option, text) for text in given))}
    if form == "distributions":
        members = KINDS[kind]["fields"][fields[0]]["members"]
        drawn = (_distribution(option, text, members) for text in given)
        return {fields[0]: once(option, drawn)}
    if form in ("values", "axis"):
        parameter, values = _one(option, given)
        return (
            dict(zip(fields, (parameter, values), strict=True))
            if form == "values"
            else {fields[0]: _axis(parameter, values)}
        )
    return dict.fromkeys(fields, given)


def once(option: str, pairs: Iterable[tuple[str, object]]) -> dict[str, object]:
    """Return what an option that may be repeated says of each name; a name twice is refused."""
    found: dict[str, object] = {}
    for name, value in pairs:
        if name in found:
            raise Stopped(f"{option} {name} is given twice; keep one.")
        found[name] = value
    return found


def _value(name: str, given: Any) -> Any:
    """Return what was typed as the field has it."""
    option, form, words = f"--{name}", FIELDS[name]["form"], FIELDS[name]["words"]
    if not isinstance(given, str) or given in words:
        return given
    if name == "section":
        return _section(given)
    if form == "axis":
        return _axis(*_values(option, given))
    if form in ("number", "integer"):
        return _number(option, given)
    parts = listed(given) or []
    if form == "numbers":
        return [_number(option, part) for part in parts]
    return parts if form == "names" else given


def _axis(name: str, values: object) -> dict[str, object]:
    """Return an axis: of a parameter, or of a number of the start, which is a JSON pointer."""
    return {"start" if name.startswith("/") else "parameter": name, "values": values}


def _one(option: str, texts: list[str]) -> tuple[str, object]:
    """Return the one parameter that an option is about, and its values."""
    if len(texts) > 1:
        sweep = " ".join(f"--sweep {text}" for text in texts)
        raise Stopped(
            f"{option} is given twice: it is over one parameter. Keep one, ask for a map of the"
            f" motion over two of them: --chart {texts[0]} --by {texts[1]}, or for extremes over"
            f" all of them: {sweep}"
        )
    return _values(option, texts[0])


def _values(option: str, text: str) -> tuple[str, object]:
    """Return name and values of ``name=from:to:count``, ``…:log`` or ``name=a,b,c``."""
    name, equals, values = text.partition("=")
    parts = values.split(":")
    known = len(parts) in (1, 3, 4) and parts[3:] in ([], ["log"], ["linear"])
    if not (name and equals and values and known):
        line = f"{option} {text}: write NAME=FROM:TO:COUNT, such as clearance=1e-4:1e-3:200."
        raise Stopped(line)
    if len(parts) == 1:
        return name, [_number(option, part) for part in values.split(",")]
    start, stop, count = (_number(option, part) for part in parts[:3])
    spacing = {"spacing": parts[3]} if parts[3:] else {}
    return name, {"from": start, "to": stop, "count": count, **spacing}


def _distribution(
    option: str, text: str, members: Mapping[str, list[str]]
) -> tuple[str, dict[str, object]]:
    """Return name and distribution of ``name=uniform:low:high``."""
    name, _, described = text.partition("=")
    kind, *numbers = described.split(":")
    if not name or len(numbers) != len(members.get(kind, ())) or kind not in members:
        forms = ", ".join(":".join([one, *map(str.upper, parts)]) for one, parts in members.items())
        raise Stopped(f"{option} {text}: write NAME= and one of {forms}.")
    values = [_number(option, number) for number in numbers]
    return name, {"distribution": kind, **dict(zip(members[kind], values, strict=True))}


def _section(text: str) -> dict[str, object]:
    name, equals, value = text.partition("=")
    if not (name and equals and value):
        raise Stopped(f"--section {text}: write crank_angle=0.5, onset=A or A.eccentricity_x=0:up.")
    if name == "onset":
        return {"onset": value}
    if name == "crank_angle":
        return {"crank_angle": _number("--section", value)}
    level, colon, direction = value.partition(":")
    crossing = {"channel": name, "value": _number("--section", level)}
    return crossing | ({"direction": direction} if colon else {})


def _number(option: str, text: str) -> object:
    """Return a number as JSON reads it; one that is whole, such as 1e2, without a point."""
    try:
        return whole(text)
    except ValueError:
        pass
    try:
        return float(text)
    except ValueError:
        raise Stopped(f"{option}: {text!r} is not a number.") from None
