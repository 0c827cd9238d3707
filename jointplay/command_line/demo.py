"""``jointplay demo``: a service from start to stop, beside the numbers of a scene's source."""

import shutil
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from jointplay.command_line.exits import Exit, Stopped

if TYPE_CHECKING:
    from jointplay.client import Client, Job
    from jointplay.command_line.comparison import Case


def demo(
    preset: Annotated[
        str, typer.Argument(metavar="PRESET", help="A scene that carries reported numbers.")
    ],
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="FOLDER", help="Where the figures go.")
    ] = Path("demo"),
    workers: Annotated[int, typer.Option(min=1, max=64, help="How many workers.")] = 2,
) -> None:
    """Start a service, run a scene's published cases over HTTP, and stop everything.

    Figures of every case go to the folder; the published numbers are printed beside ours.

    Example: `jointplay demo seven-bar-press -o demo`
    """
    from jointplay.client import Client
    from jointplay.command_line.comparison import cases_of, table
    from jointplay.serving import running_service
    from solver import presets

    scene = _published(presets.document(preset, pointer="PRESET"))
    cases = cases_of(scene)
    data = output / "service"
    shutil.rmtree(data, ignore_errors=True)  # what an earlier demo left
    typer.echo("starting broker, API and workers")
    with running_service(data, workers=workers) as url, Client(url) as client:
        typer.echo(f"the service answers at {url}; submitting {len(cases)} jobs")
        jobs = _finished(client, [client.submit(case.job(preset)).id for case in cases])
        peaks = [client.peaks(job.id) for job in jobs]
        _fetch_figures(client, cases, jobs, output)
    typer.echo(f"everything is stopped\n\nsource: {scene['source']}")
    typer.echo("\n".join(table(cases, peaks)))
    typer.echo(f"figures are in {output}/")


def _published(scene: dict[str, Any]) -> dict[str, Any]:
    if not scene.get("reported"):
        line = f"{scene['name']} carries no reported numbers to be set beside ours."
        raise Stopped(Exit.BAD_INPUT, line)
    return scene


def _finished(client: "Client", ids: list[str]) -> list["Job"]:
    """Wait for all jobs under one progress bar; end with the reason of the first that failed."""
    from jointplay.command_line.progress import progress
    from jointplay.command_line.waiting import exit_of

    finished: list[Job] = []
    with progress("simulating") as report:

        def show(job: "Job") -> None:
            fraction = (len(finished) + job.progress.fraction) / len(ids)
            report(fraction, f"{job.label}: {job.state}")

        for job_id in ids:
            finished.append(client.wait(job_id, show))
            exit_of(finished[-1])
    return finished


def _fetch_figures(client: "Client", cases: list["Case"], jobs: list["Job"], output: Path) -> None:
    from jointplay.command_line.progress import progress

    wanted = [
        (case, job, name)
        for case, job in zip(cases, jobs, strict=True)
        for name in client.figures(job.id)
    ]
    with progress("fetching figures") as report:
        for done, (case, job, name) in enumerate(wanted):
            report(done / len(wanted), f"{case.label}: {name}")
            folder = output / case.folder
            folder.mkdir(parents=True, exist_ok=True)
            (folder / f"{name}.png").write_bytes(client.figure(job.id, name))
        report(1.0, f"{len(wanted)} files")
