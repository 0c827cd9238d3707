"""``jointplay compare``: several runs over one another, and a table of their peaks."""

import json
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from jointplay.command_line.exits import Stopped
from jointplay.command_line.figure_options import form_of, page_of, with_figure_options
from jointplay.command_line.options import AS_JSON, DEFAULT_URL, URL, job_of
from jointplay.command_line.output import print_result
from jointplay.command_line.peaks import peak_rows, peak_table
from jointplay.command_line.typed_window import check_ends, check_start
from jointplay.records.whole_file import write_whole

if TYPE_CHECKING:
    from jointplay.client import Job
    from jointplay.figures import Form, Options
    from jointplay.figures.overlay import Curve

_MOST_PANELS = 6
_SPANS = 2000
"""Spans of a curve, each drawn through its smallest and its largest value."""


@with_figure_options
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
        Path,
        typer.Option("-o", "--output", metavar="FILE", help="The figure: .png, .svg, .pdf, .eps."),
    ] = Path("comparison.png"),
    as_json: AS_JSON = False,
    url: URL = DEFAULT_URL,
    **options: Any,
) -> None:
    """Draw channels of several simulations over one another, and print their peaks side by side.

    With --start or --stop, the peaks are those of that window.

    Example: `jointplay compare OUT1 OUT2 --channels displacement --stop 0.5 -o both.svg`
    """
    from jointplay.command_line.window_peaks import peaks_inside
    from jointplay.figures.overlay import MOST_CURVES, Curve

    check_ends(start, stop)
    form, page = form_of(output), page_of(options)
    if not 2 <= len(results) <= MOST_CURVES:
        raise Stopped(f"compare takes 2 to {MOST_CURVES} runs, not {len(results)}.")
    windowed = (start, stop) != (None, None)
    with ExitStack() as stack:
        jobs = [stack.enter_context(job_of(one, url)) for one in results]
        for name, job in zip(results, jobs, strict=True):
            if job.is_study:
                raise Stopped(f"{name} is a {job.kind}; compare simulations.")
            check_start(job, start)
        peaks = [{row["channel"]: row for row in peak_rows(job.results.peaks())} for job in jobs]
        common = [name for name in peaks[0] if all(name in one for one in peaks)]
        labels = _labels(jobs) or results
        names = _chosen(jobs, common, channels)
        drawn = names[:_MOST_PANELS]
        panels: dict[str, list[Curve]] = {name: [] for name in drawn}
        for job, label in zip(jobs, labels, strict=True):
            window = job.window(drawn, start, stop, points=_SPANS)
            for name, one in window.channels.items():
                panels[name].append(Curve(label, one.unit, window.time, one.values))
        write_whole(output, _drawn(panels, form, page))
        if windowed:
            peaks = [peaks_inside(job, names, start, stop, _SPANS) for job in jobs]
        about = _span(start, stop) if windowed else _settled(jobs, labels)
        about = [*about, *_ended_early(jobs, labels)]
    of_runs = list(zip(labels, peaks, strict=True))
    table = [{"run": label, **of_run[name]} for name in names for label, of_run in of_runs]
    found = {"figure": str(output), "start": start, "stop": stop, "peaks": table}
    print_result(found, [*about, *peak_table(table, "run"), output], as_json=as_json)


def _span(start: float | None, stop: float | None) -> list[str]:
    begin = "" if start is None else f" from t = {start:g} s"
    end = "" if stop is None else f" to t = {stop:g} s"
    return [f"peaks{begin}{end}"]


def _settled(jobs: list["Job"], labels: list[str]) -> list[str]:
    """Say which peaks are not of a whole run, because the job leaves out what comes before."""
    settles = [job.job.get("settle") for job in jobs]
    pairs = zip(labels, settles, strict=True)
    return [f"peaks of {label} from t = {settle:g} s on" for label, settle in pairs if settle]


def _ended_early(jobs: list["Job"], labels: list[str]) -> list[str]:
    """Say which runs have not come to their end, and how far they came."""
    return [
        f"{label} is {job.state} at t = {job.progress.time:.6g} s of {job.job['duration']:g} s:"
        " its peaks and curves are of that"
        for label, job in zip(labels, jobs, strict=True)
        if job.state != "succeeded"
    ]


def _drawn(panels: dict[str, list["Curve"]], form: "Form", page: "Options") -> bytes:
    from jointplay.figures import NotDrawable
    from jointplay.figures.overlay import draw_overlay

    try:
        return draw_overlay(panels, form, page)
    except NotDrawable as error:
        raise Stopped(f"--{error.cause.replace('_', '-')}: {error}") from None


def _labels(jobs: list["Job"]) -> list[str] | None:
    """Tell runs apart by their own labels, else by the parameters in which they differ."""
    facts = [_facts(job.job) for job in jobs]
    differing = [name for name in facts[0] if len({json.dumps(one.get(name)) for one in facts}) > 1]
    by_facts = [
        " ".join(f"{name}={_short(one[name])}" for name in differing[:3] if name in one)
        for one in facts
    ]
    for labels in ([job.label or "" for job in jobs], by_facts):
        if all(labels) and len(set(labels)) == len(labels):
            return labels
    return None


def _facts(job: dict[str, Any]) -> dict[str, Any]:
    scene = job["scene"]
    return (
        {"scene": scene.get("preset") or scene.get("name")}
        | _values(scene)
        | {name: job.get(name) for name in ("method", "tolerance", "formulation", "duration")}
    )


def _values(scene: dict[str, Any]) -> dict[str, Any]:
    """Return the parameters of a job's scene: of a preset their values, of a document defaults."""
    parameters = scene.get("parameters", {})
    if "preset" in scene:
        return dict(parameters)
    given = {name: one["default"] for name, one in parameters.items()}
    return {name: value for name, value in given.items() if value is not None}


def _short(value: object) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


def _chosen(jobs: list["Job"], common: list[str], wanted: str | None) -> list[str]:
    from jointplay.records.channel_choice import NoSuchChannel, choose

    if not common:
        raise Stopped("The runs have no channel in common.")
    if wanted is not None:
        try:
            return choose(wanted, common)
        except NoSuchChannel as error:
            raise Stopped(str(error)) from None
    declared = [one["name"] for job in jobs for one in job.job["scene"].get("outputs", [])]
    outputs = [name for name in declared if name in common]
    first = dict.fromkeys([*outputs, *(name for name in common if "." not in name)])
    first |= dict.fromkeys(name for name in common if name.endswith(".normal_force"))
    return [*first][:_MOST_PANELS] or common[:_MOST_PANELS]
