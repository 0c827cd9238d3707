"""``jointplay plot``: figures of a local run or of a service's job."""

from pathlib import Path
from typing import Annotated, Any

import typer

from jointplay.command_line import connection, output_folder
from jointplay.command_line.drawing import Form
from jointplay.command_line.exits import Exit, Stopped
from jointplay.command_line.progress import progress
from jointplay.command_line.study_options import listed


def plot(
    results: Annotated[
        str, typer.Argument(metavar="OUT|ID", help="Folder of `jointplay run`, or id of a job.")
    ],
    names: Annotated[
        list[str] | None,
        typer.Argument(metavar="[FIGURE]...", help="Figures or channels; default all figures."),
    ] = None,
    channels: Annotated[
        str | None, typer.Option(metavar="A,B", help="Channels that the figures show.")
    ] = None,
    joints: Annotated[
        str | None, typer.Option(metavar="A,B", help="Joints that the figures show.")
    ] = None,
    start: Annotated[
        float | None,
        typer.Option(metavar="SECONDS", help="From this time; first point of a study."),
    ] = None,
    stop: Annotated[
        float | None, typer.Option(metavar="SECONDS", help="To this time; before this point.")
    ] = None,
    folder: Annotated[
        Path, typer.Option("-o", "--output", metavar="FOLDER", help="Where the files go.")
    ] = Path(),
    form: Annotated[Form, typer.Option("--format", help="File type.")] = "png",
    url: connection.URL = connection.DEFAULT_URL,
) -> None:
    """Draw figures: those of the job's mechanism, of a study, or of any channel.

    Examples: `jointplay plot OUT acceleration A.normal_force --format svg -o figures`,
    `jointplay plot OUT section --start 42 --stop 43` for one value of a bifurcation diagram
    """
    chosen = {
        "channels": listed(channels),
        "joints": listed(joints),
        "start": start,
        "stop": stop,
    }
    given = {name: value for name, value in chosen.items() if value is not None}
    if given and not names:
        line = f"--{next(iter(given))} chooses what a figure shows; name the figure."
        raise Stopped(Exit.BAD_INPUT, line)
    if output_folder.is_of_service(results):
        written = _fetch(results, names, folder, form, given, url)
    else:
        written = _draw(Path(results), names, folder, form, given)
    for path in written:
        typer.echo(path)


def _draw(
    results: Path, names: list[str] | None, folder: Path, form: Form, chosen: dict[str, Any]
) -> list[Path]:
    from jointplay import figures
    from jointplay.command_line.drawing import draw, draw_all
    from jointplay.command_line.export import point_range

    source = output_folder.results_in(results)
    if not names:
        return draw_all(source, folder, form)
    start, stop = chosen.get("start"), chosen.get("stop")
    names_of = (tuple(chosen.get("channels", ())), tuple(chosen.get("joints", ())))
    if not figures.is_study(source):
        selection = figures.Selection(*names_of, start=start, stop=stop)
        return draw(source, names, folder, form, selection)
    points = point_range(source.points, start, stop)
    selection = figures.Selection(
        *names_of,
        first=None if start is None else points[0],
        last=None if stop is None else points[-1],
    )
    return draw(source, names, folder, form, selection)


def _fetch(
    job_id: str,
    names: list[str] | None,
    folder: Path,
    form: Form,
    chosen: dict[str, Any],
    url: str,
) -> list[Path]:
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    with connection.connect(url) as client, progress("figures") as report:
        wanted = names or client.figures(job_id)
        for done, name in enumerate(wanted):
            report(done / len(wanted), name)
            path = folder / f"{name}.{form}"
            path.write_bytes(client.figure(job_id, name, form, **chosen))
            written.append(path)
        report(1.0, "")
    return written
