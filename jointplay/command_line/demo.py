"""``jointplay demo``: a service from start to stop, beside the numbers of a scene's source."""

import shutil
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from jointplay.command_line.exits import Stopped
from jointplay.command_line.options import AS_JSON
from jointplay.command_line.output import tell

if TYPE_CHECKING:
    from jointplay.client import Job
    from jointplay.command_line.comparison import Case


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

    Figures of every case go to the folder; the published numbers are printed beside ours.

    Example: `jointplay demo seven-bar-press -o demo`
    """
    from jointplay.client import Client
    from jointplay.command_line.comparison import cases_of, rows_of, table
    from jointplay.service.processes import running_service
    from jointplay.solver.scene import presets

    scene = presets.document(preset, pointer="PRESET")
    if not scene.get("reported"):
        raise Stopped(f"{scene['name']} carries no reported numbers to be set beside ours.")
    cases = cases_of(scene)
    data = output / "service"
    shutil.rmtree(data, ignore_errors=True)  # what an earlier demo left
    typer.echo("starting broker, API and workers", err=as_json)
    with running_service(data, workers=workers) as url, Client(url) as client:
        typer.echo(f"the service answers at {url}; submitting {len(cases)} jobs", err=as_json)
        jobs = _finished([client.submit(case.job(preset)) for case in cases])
        peaks = [job.results.peaks() for job in jobs]
        _fetch_figures(cases, jobs, output)
    rows = rows_of(cases, peaks)
    facts = {"source": scene["source"], "figures": str(output), "comparison": rows}
    lines = [f"everything is stopped\n\nsource: {scene['source']}", *table(rows)]
    tell(facts, [*lines, f"figures are in {output}/"], as_json=as_json)


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


def _fetch_figures(cases: list["Case"], jobs: list["Job"], output: Path) -> None:
    from jointplay.progress import progress

    pairs = zip(cases, jobs, strict=True)
    wanted = [(case, job, name) for case, job in pairs for name in job.figures]
    with progress("fetching figures") as report:
        for done, (case, job, name) in enumerate(wanted):
            report(done / len(wanted), f"{case.label}: {name}")
            folder = output / case.folder
            folder.mkdir(parents=True, exist_ok=True)
            job.figure(name).save(folder / name)
        report(1.0, f"{len(wanted)} files")
