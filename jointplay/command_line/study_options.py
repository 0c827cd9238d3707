"""Options that ask for a study without a document: ranges, sections, lists."""

from typing import Annotated, Any

import typer

from jointplay.command_line.exits import Exit, Stopped

BIFURCATION = Annotated[
    str | None,
    typer.Option(
        metavar="NAME=FROM:TO:COUNT",
        help="A bifurcation diagram over a parameter; append `:log` for equal ratios.",
    ),
]
SWEEP = Annotated[
    list[str] | None,
    typer.Option(
        metavar="NAME=FROM:TO:COUNT",
        help="Extremes over a parameter, or NAME=A,B,C; repeat it for every combination.",
    ),
]
POINCARE = Annotated[bool, typer.Option("--poincare", help="Poincaré sections over many periods.")]
ENSEMBLE = Annotated[
    int | None, typer.Option(metavar="MEMBERS", help="Sections of many perturbed starts.")
]
ACCURACY_STUDY = Annotated[
    bool,
    typer.Option("--accuracy-study", help="What every method and tolerance costs and buys."),
]
PERIODS = Annotated[
    float | None, typer.Option(help="Of a sweep: duration of each point in its periods.")
]
STATISTICS = Annotated[
    str | None,
    typer.Option(
        metavar="A,B",
        help="Of a sweep, beside the extremes: mean, root_mean_square, contact_share and others.",
    ),
]
SETTLE = Annotated[
    str | None, typer.Option(metavar="PERIODS", help="What is left out before, or `auto`.")
]
RECORD = Annotated[int | None, typer.Option(metavar="N", help="Sections kept of each point.")]
SECTION = Annotated[
    str | None,
    typer.Option(
        metavar="WHERE",
        help="Of a study: crank_angle=RAD, onset=JOINT, or CHANNEL=VALUE:up (or down).",
    ),
]
OBSERVABLES = Annotated[
    str | None, typer.Option(metavar="A,B", help="Channels taken at sections, names or globs.")
]
INDICATORS = Annotated[
    str | None,
    typer.Option(metavar="A,B", help="lyapunov, zero_one, recurrence, rotation, spectrum or all."),
]
CONTINUATION = Annotated[
    str | None, typer.Option(help="forward, backward or both: start from the neighbour's end.")
]
CHAINS = Annotated[
    int | None, typer.Option(help="Segments that a continuation is cut into; default 8.")
]


def study_fields(
    *,
    bifurcation: str | None,
    sweep: list[str] | None,
    poincare: bool,
    ensemble: int | None,
    accuracy_study: bool,
    settle: str | None,
    statistics: str | None,
    section: str | None,
    observables: str | None,
    indicators: str | None,
    **fields: Any,
) -> dict[str, Any]:
    """Return the options as fields of a job; those that were not given are None."""
    asked = {
        "--bifurcation": bifurcation is not None,
        "--sweep": bool(sweep),
        "--poincare": poincare,
        "--ensemble": ensemble is not None,
        "--accuracy-study": accuracy_study,
    }
    chosen = [option for option, given in asked.items() if given]
    if len(chosen) > 1:
        raise Stopped(Exit.BAD_INPUT, f"{chosen[0]} and {chosen[1]} are two jobs; give one.")
    if chosen:
        fields["kind"] = chosen[0].removeprefix("--")
    if bifurcation is not None:
        fields["parameter"], fields["values"] = _values("--bifurcation", bifurcation)
    if sweep:
        fields["grid"] = dict(_values("--sweep", text) for text in sweep)
    return fields | {
        "members": ensemble,
        "settle": None if settle is None else _number("--settle", settle, word="auto"),
        "statistics": listed(statistics),
        "section": None if section is None else _section(section),
        "observables": listed(observables),
        "indicators": "all" if indicators == "all" else listed(indicators),
    }


def listed(text: str | None) -> list[str] | None:
    """Return the parts of a comma-separated list."""
    return None if text is None else [part.strip() for part in text.split(",")]


def _values(option: str, text: str) -> tuple[str, object]:
    """Return name and values of ``name=from:to:count``, ``…:log`` or ``name=a,b,c``."""
    name, equals, values = text.partition("=")
    if not (name and equals and values):
        raise _wrong(option, text)
    if ":" not in values:
        return name, [_number(option, part) for part in values.split(",")]
    parts = values.split(":")
    if len(parts) not in (3, 4) or parts[3:] not in ([], ["log"], ["linear"]):
        raise _wrong(option, text)
    start, stop, count = (_number(option, part) for part in parts[:3])
    spacing = {"spacing": parts[3]} if parts[3:] else {}
    return name, {"from": start, "to": stop, "count": count, **spacing}


def _section(text: str) -> dict[str, object]:
    name, equals, value = text.partition("=")
    if not (name and equals and value):
        line = f"--section {text}: write crank_angle=0.5, onset=A or A.eccentricity_x=0:up."
        raise Stopped(Exit.BAD_INPUT, line)
    if name == "onset":
        return {"onset": value}
    if name == "crank_angle":
        return {"crank_angle": _number("--section", value)}
    level, colon, direction = value.partition(":")
    crossing = {"channel": name, "value": _number("--section", level)}
    return crossing | ({"direction": direction} if colon else {})


def _number(option: str, text: str, word: str | None = None) -> object:
    """Return a number as JSON reads it, so that it means the same in a document."""
    if text == word:
        return text
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    raise Stopped(Exit.BAD_INPUT, f"{option}: {text!r} is not a number.")


def _wrong(option: str, text: str) -> Stopped:
    line = f"{option} {text}: write NAME=FROM:TO:COUNT, such as clearance=1e-4:1e-3:200."
    return Stopped(Exit.BAD_INPUT, line)
