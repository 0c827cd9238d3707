"""``jointplay compare``: several runs over one another, and a table of their peaks."""

import json
from collections.abc import Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from jointplay.command_line import connection
from jointplay.command_line.drawing import Form
from jointplay.command_line.exits import Exit, Stopped
from jointplay.command_line.job_options import listed
from jointplay.command_line.output import AS_JSON, print_json
from jointplay.command_line.peaks import print_peaks, rows_of

if TYPE_CHECKING:
    from jointplay.client import Job, Peak
    from jointplay.figures.overlay import Curve

_MOST_PANELS = 6


@dataclass(frozen=True)
class _Run:
    """One run: what tells it from the others, and its peaks."""

    name: str
    job: "Job"
    outputs: list[str]
    peaks: "Mapping[str, Peak]"


def compare(
    results: Annotated[
        list[str], typer.Argument(metavar="OUT|ID...", help="Runs: folders, or ids of jobs.")
    ],
    channels: Annotated[
        str | None,
        typer.Option(metavar="A,B", help="Channels to compare; default outputs and contact force."),
    ] = None,
    start: Annotated[float | None, typer.Option(metavar="SECONDS", help="From this time.")] = None,
    stop: Annotated[float | None, typer.Option(metavar="SECONDS", help="To this time.")] = None,
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="FILE", help="The figure, .png or .svg.")
    ] = Path("comparison.png"),
    as_json: AS_JSON = False,
    url: connection.URL = connection.DEFAULT_URL,
) -> None:
    """Draw channels of several simulations over one another, and print their peaks side by side.

    Example: `jointplay compare OUT1 OUT2 --channels displacement --stop 0.5 -o both.svg`
    """
    from jointplay.figures.overlay import MOST_CURVES, draw_overlay

    form = _form_of(output)
    if not 2 <= len(results) <= MOST_CURVES:
        line = f"compare takes 2 to {MOST_CURVES} runs, not {len(results)}."
        raise Stopped(Exit.BAD_INPUT, line)
    with ExitStack() as stack:
        jobs = [stack.enter_context(connection.job_of(one, url)) for one in results]
        runs = [_run(name, job) for name, job in zip(results, jobs, strict=True)]
        labels = _labels(runs)
        names = _chosen(runs, listed(channels))
        drawn = names[:_MOST_PANELS]
        curves = [
            _curves(run, label, drawn, start, stop) for run, label in zip(runs, labels, strict=True)
        ]
        panels = {name: [of_run[name] for of_run in curves] for name in drawn}
        output.write_bytes(draw_overlay(panels, form))
    table = _table(runs, labels, names)
    if as_json:
        print_json({"figure": str(output), "peaks": table})
        return
    print_peaks(table, "run")
    typer.echo(output)


def _form_of(path: Path) -> Form:
    forms: dict[str, Form] = {".png": "png", ".svg": "svg"}
    if path.suffix not in forms:
        raise Stopped(Exit.BAD_INPUT, f"{path}: a figure's name ends in .png or .svg.")
    return forms[path.suffix]


def _run(name: str, job: "Job") -> _Run:
    if job.is_study:
        raise Stopped(Exit.BAD_INPUT, f"{name} is a {job.kind}; compare simulations.")
    outputs = [one["name"] for one in job.job["scene"].get("outputs", [])]
    return _Run(name, job, outputs, job.results.peaks())


def _labels(runs: list[_Run]) -> list[str]:
    """Tell runs apart by their own labels, else by the parameters in which they differ."""
    own = [run.job.label or "" for run in runs]
    if all(own) and len(set(own)) == len(own):
        return own
    facts = [_facts(run.job.job) for run in runs]
    differing = [name for name in facts[0] if len({json.dumps(one.get(name)) for one in facts}) > 1]
    labels = [
        " ".join(f"{name}={_short(one.get(name))}" for name in differing[:3]) for one in facts
    ]
    if all(labels) and len(set(labels)) == len(labels):
        return labels
    return [run.name for run in runs]


def _facts(job: dict[str, Any]) -> dict[str, Any]:
    scene = job["scene"]
    found = {"scene": scene.get("preset") or scene.get("name")}
    found |= scene.get("parameters", {}) if "preset" in scene else {}
    return found | {
        name: job.get(name) for name in ("method", "tolerance", "formulation", "duration")
    }


def _short(value: object) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


def _chosen(runs: list[_Run], wanted: list[str] | None) -> list[str]:
    from jointplay.records.channel_choice import NoSuchChannel, choose

    common = [name for name in runs[0].peaks if all(name in run.peaks for run in runs)]
    if not common:
        raise Stopped(Exit.BAD_INPUT, "The runs have no channel in common.")
    if wanted is not None:
        try:
            return choose(",".join(wanted), common)
        except NoSuchChannel as error:
            raise Stopped(Exit.BAD_INPUT, " ".join(error.sentences)) from None
    outputs = [name for run in runs for name in run.outputs if name in common]
    first = [*dict.fromkeys(outputs), *(n for n in common if "." not in n and n not in outputs)]
    first += [name for name in common if name.endswith(".normal_force")]
    return first[:_MOST_PANELS] or common[:_MOST_PANELS]


def _curves(
    run: _Run, label: str, names: list[str], start: float | None, stop: float | None
) -> "dict[str, Curve]":
    from jointplay.figures.overlay import Curve

    found = run.job.window(names, start, stop)
    return {
        name: Curve(label, one.unit, found.time, one.values) for name, one in found.channels.items()
    }


def _table(runs: list[_Run], labels: list[str], names: list[str]) -> list[dict[str, Any]]:
    rows = [{row["channel"]: row for row in rows_of(run.peaks)} for run in runs]
    return [
        {"run": label, **of_run[name]}
        for name in names
        for of_run, label in zip(rows, labels, strict=True)
    ]
