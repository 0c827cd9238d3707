"""``jointplay plot``: figures of a local run or of a service's job."""

from pathlib import Path
from typing import Annotated

import typer

from jointplay.command_line import connection, output_folder
from jointplay.command_line.drawing import Form
from jointplay.command_line.progress import progress


def plot(
    results: Annotated[
        str, typer.Argument(metavar="OUT|ID", help="Folder of `jointplay run`, or id of a job.")
    ],
    names: Annotated[
        list[str] | None,
        typer.Argument(metavar="[FIGURE]...", help="Figures or channels; default all figures."),
    ] = None,
    folder: Annotated[
        Path, typer.Option("-o", "--output", metavar="FOLDER", help="Where the files go.")
    ] = Path(),
    form: Annotated[Form, typer.Option("--format", help="File type.")] = "png",
    url: connection.URL = connection.DEFAULT_URL,
) -> None:
    """Draw figures: those of the job's mechanism, or the history of any channel.

    Example: `jointplay plot OUT acceleration A.normal_force --format svg -o figures`
    """
    if not output_folder.is_job_id(results):
        from jointplay.command_line.drawing import draw, draw_all
        from storage.results import ResultReader

        source = ResultReader(output_folder.store_in(Path(results)))
        written = draw(source, names, folder, form) if names else draw_all(source, folder, form)
    else:
        written = _fetch(results, names, folder, form, url)
    for path in written:
        typer.echo(path)


def _fetch(job_id: str, names: list[str] | None, folder: Path, form: Form, url: str) -> list[Path]:
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    with connection.connect(url) as client, progress("figures") as report:
        wanted = names or client.figures(job_id)
        for done, name in enumerate(wanted):
            report(done / len(wanted), name)
            path = folder / f"{name}.{form}"
            path.write_bytes(client.figure(job_id, name, form))
            written.append(path)
        report(1.0, "")
    return written
