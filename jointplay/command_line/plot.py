"""``jointplay plot``: figures of a local run or of a service's job."""

from pathlib import Path
from typing import Annotated

import typer

from jointplay.command_line.exits import Stopped
from jointplay.command_line.options import (
    AS_JSON,
    DEFAULT_URL,
    RESULTS,
    START,
    STOP,
    URL,
    Form,
    job_of,
    listed,
)
from jointplay.command_line.output import tell
from jointplay.progress import progress


def plot(
    results: RESULTS,
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
    start: START = None,
    stop: STOP = None,
    folder: Annotated[
        Path, typer.Option("-o", "--output", metavar="FOLDER", help="Where the files go.")
    ] = Path(),
    form: Annotated[Form, typer.Option("--format", help="File type.")] = "png",
    as_json: AS_JSON = False,
    url: URL = DEFAULT_URL,
) -> None:
    """Draw figures: those of the job's mechanism, of a study, or of any channel.

    Examples: `jointplay plot OUT acceleration A.normal_force --format svg -o figures`,
    `jointplay plot OUT section --start 42 --stop 43` for one value of a bifurcation diagram
    """
    chosen = {"channels": channels, "joints": joints, "start": start, "stop": stop}
    given = [name for name, value in chosen.items() if value is not None]
    if given and not names:
        raise Stopped(f"--{given[0]} chooses what a figure shows; name the figure.")
    written = []
    with job_of(results, url) as job, progress("figures") as report:
        wanted = names or job.figures
        folder.mkdir(parents=True, exist_ok=True)
        for done, name in enumerate(wanted):
            report(done / len(wanted), name)
            picture = job.figure(
                name,
                channel=listed(channels) or (),
                joint=listed(joints) or (),
                start=start,
                stop=stop,
                form=form,
            )
            path = folder / f"{name}.{form}"
            path.write_bytes(picture.content)
            written.append({"name": name, "path": str(path)})
        report(1.0, "")
    tell({"figures": written}, [one["path"] for one in written], as_json=as_json)
