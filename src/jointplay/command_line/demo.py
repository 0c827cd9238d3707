"""``jointplay demo``: a service from start to stop, beside the numbers of a scene's source."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import typer

from jointplay.command_line.exits import Stopped
from jointplay.command_line.options import AS_JSON
from jointplay.command_line.output import aligned, print_result

if TYPE_CHECKING:
    from jointplay.client import Job, Peak


SAMPLES = 10_000  # of each case: fine enough that figures show the impacts
FIGURES = ("mechanism", "outputs", "contact-force", "orbit")
"""Figures of each case, where there are such; the others can be drawn of what is kept."""


def demo(
    preset: Annotated[
        str, typer.Argument(metavar="PRESET", help="A scene that carries reported numbers.")
    ],
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="FOLDER", help="Where the figures go.")
    ] = Path("demo"),
    workers: Annotated[int, typer.Option(min=1, max=64, help="How many workers.")] = 2,
    as_json: AS_JSON = False,
) -> None:
    """Start a service, run a scene's published cases over HTTP, and stop everything.

    Figures of every case go to the folder; the published numbers are printed beside ours. The jobs
    are kept there, too, with those of earlier times: the last lines printed are the commands that
    draw other figures of them.

    Example: `jointplay demo seven-bar-press -o demo`
    """
    from jointplay.client import Client
    from jointplay.service.processes import running_service
    from jointplay.solver.scene import presets

    scene = presets.document(preset, pointer="PRESET")
    if not scene.get("reported"):
        raise Stopped(f"{scene['name']} carries no reported numbers to be set beside ours.")
    cases = cases_of(scene)
    data = _data_folder(output)
    typer.echo("starting broker, API and workers", err=as_json)
    with running_service(data, workers=workers) as url, Client(url) as client:
        typer.echo(f"the service answers at {url}; submitting {len(cases)} jobs", err=as_json)
        jobs = _finished([client.submit(case.job(preset)) for case in cases])
        peaks = [job.results.peaks() for job in jobs]
        _fetch_figures(cases, jobs, output)
    rows = rows_of(cases, peaks)
    facts = {"source": scene["source"], "figures": str(output), "comparison": rows}
    lines = [
        f"everything is stopped\n\nsource: {scene['source']}",
        scene["description"],
        *table(rows),
    ]
    lines += [
        f"figures are in {output}/; all others of a case can be drawn while its service is up:",
        f"  jointplay serve --data {data}",
        f"  jointplay plot {jobs[-1].id}",
    ]
    print_result(facts, lines, as_json=as_json)


def _data_folder(output: Path) -> Path:
    """Return where the service keeps its jobs: what is there already is kept."""
    data = output / "service"
    if data.is_dir() and any(data.iterdir()) and not (data / "catalogue.sqlite").exists():
        raise Stopped(f"{data} holds something else than a service; give another folder with -o.")
    return data


def _finished(jobs: list["Job"]) -> list["Job"]:
    """Wait for all jobs under one progress bar; end with the reason of the first that failed."""
    from jointplay.progress import progress

    with progress("simulating") as report:
        for done, job in enumerate(jobs):

            def show(job: "Job", done: int = done) -> None:
                fraction = (done + job.progress.fraction) / len(jobs)
                report(fraction, f"{job.label}: {job.state}")

            job.wait(report=show)
    return jobs


def _fetch_figures(cases: "list[Case]", jobs: list["Job"], output: Path) -> None:
    from jointplay.progress import progress

    pairs = zip(cases, jobs, strict=True)
    wanted = [(case, job, name) for case, job in pairs for name in job.figures if name in FIGURES]
    with progress("fetching figures") as report:
        for done, (case, job, name) in enumerate(wanted):
            report(done / len(wanted), f"{case.label}: {name}")
            folder = output / case.folder
            folder.mkdir(parents=True, exist_ok=True)
            job.figure(name).save(folder / name)
        report(1.0, f"{len(wanted)} files")


class Case(NamedTuple):
    """One job of the comparison, and the numbers that the scene's source prints for it."""

    parameters: dict[str, float | str]
    duration: float
    reported: list[dict[str, Any]]

    @property
    def label(self) -> str:
        """Short name."""
        return label(self.parameters)

    @property
    def folder(self) -> str:
        """The label as the name of a folder."""
        return self.label.replace(" ", "_") or "defaults"

    def job(self, preset: str) -> dict[str, Any]:
        """Return the job document."""
        scene = {"preset": preset, "parameters": self.parameters}
        return {
            "kind": "simulate",
            "scene": scene,
            "duration": self.duration,
            "output_step": self.duration / SAMPLES,
            "label": self.label,
        }


def cases_of(scene: Mapping[str, Any]) -> list[Case]:
    """Group a scene's reported numbers by the job that computes them."""
    cases: dict[tuple[object, ...], Case] = {}
    for entry in scene.get("reported", []):
        key = (*sorted(entry["parameters"].items()), entry["duration"])
        case = Case(entry["parameters"], entry["duration"], [])
        cases.setdefault(key, case).reported.append(entry)
    return list(cases.values())


def rows_of(cases: Sequence[Case], peaks: Sequence[Mapping[str, "Peak"]]) -> list[dict[str, Any]]:
    """Return every reported number beside ours; `peaks` are those of each case by channel."""
    return [
        {
            **{name: entry[name] for name in ("where", "channel", "statistic", "unit")},
            "parameters": case.parameters,
            "reported": entry["value"],
            "ours": getattr(found[entry["channel"]], entry["statistic"]),
            "note": entry.get("note", ""),
        }
        for case, found in zip(cases, peaks, strict=True)
        for entry in case.reported
    ]


def table(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """Return the lines of the table of `rows_of`, and the notes below it."""
    head = ("source", "case", "quantity", "reported", "ours", "ours/reported", "")
    notes = list(dict.fromkeys(row["note"] for row in rows if row["note"]))
    lines = [
        (
            row["where"],
            label(row["parameters"]),
            f"{row['statistic']} of {row['channel']} [{row['unit']}]",
            f"{row['reported']:g}",
            f"{row['ours']:.6g}",
            f"{row['ours'] / row['reported']:.4f}",
            f"({notes.index(row['note']) + 1})" if row["note"] else "",
        )
        for row in rows
    ]
    return [*aligned([head, *lines])] + [
        f"({number}) {note}" for number, note in enumerate(notes, 1)
    ]


def label(parameters: Mapping[str, float | str]) -> str:
    """Return a short name of a case, such as ``clearance=0.0003 friction=0.01``."""
    return " ".join(
        f"{name}={value:g}" if isinstance(value, float) else f"{name}={value}"
        for name, value in parameters.items()
    )
