"""``jointplay plot``: figures of a local run or of a service's job."""

from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, NamedTuple, cast

import typer

from jointplay.command_line.exits import Exit, Stopped
from jointplay.command_line.figure_options import SHOWN, page_of, with_figure_options
from jointplay.command_line.figure_paths import FigurePaths, figure_paths
from jointplay.command_line.film import draw_film, is_film
from jointplay.command_line.options import (
    AS_JSON,
    DEFAULT_URL,
    RESULTS,
    START,
    STOP,
    URL,
    job_of,
    listed,
    refused_as_typed,
    whole,
)
from jointplay.command_line.output import print_result, remark
from jointplay.command_line.typed_window import check_ends, check_start
from jointplay.progress import progress
from jointplay.records.figure_form import FilmForm, Form
from jointplay.records.whole_file import write_whole

if TYPE_CHECKING:
    from jointplay.client import Job


NAMES = Annotated[
    list[str] | None,
    typer.Argument(metavar="[FIGURE]...", help="Figures or channels; default all figures."),
]
CHANNELS = Annotated[
    str | None, typer.Option(metavar="A,B", help="Channels that the figures show.")
]
JOINTS = Annotated[str | None, typer.Option(metavar="A,B", help="Joints that the figures show.")]
OVER = Annotated[
    str | None,
    typer.Option(
        metavar="OUT|ID", help="A chart, basins or, of branches, a diagram, over which orbits lie."
    ),
]
OUTPUT = Annotated[
    Path,
    typer.Option("-o", "--output", metavar="FOLDER|FILE", help="Where figures or one go."),
]
FORM = Annotated[
    Literal[Form, FilmForm] | None,
    typer.Option("--format", help="File type; default png, of the animation alone gif."),
]
RATE = Annotated[
    float | None,
    typer.Option(
        metavar="SHARE",
        help="Of an animation, seconds of motion in one second; default so that it lasts 6 s.",
    ),
]
FRAMES = Annotated[
    int | None, typer.Option(metavar="N", help="Of an animation; default 20.", parser=whole)
]
IMPACTS = Annotated[
    bool, typer.Option("--impact-to-impact", help="Of an animation, a frame for each impact.")
]


@with_figure_options
def plot(
    results: RESULTS,
    names: NAMES = None,
    channels: CHANNELS = None,
    joints: JOINTS = None,
    start: START = None,
    stop: STOP = None,
    over: OVER = None,
    output: OUTPUT = Path(),
    form: FORM = None,
    rate: RATE = None,
    frames_per_second: FRAMES = None,
    impact_to_impact: IMPACTS = False,
    as_json: AS_JSON = False,
    url: URL = DEFAULT_URL,
    **options: Any,
) -> None:
    """Draw figures: those of the job's mechanism, of a study, or of any channel.

    Examples: `jointplay plot OUT acceleration A.normal_force --format pdf -o figures`,
    `jointplay plot OUT orbit --units um --width 170 --title "Journal centres"`,
    `jointplay plot OUT section --start 42 --stop 43` for one value of a bifurcation diagram,
    `jointplay plot OUT curves --over CHART` for curves over the map of a chart,
    `jointplay plot OUT animation --start 0.2 --stop 0.21 --rate 0.002` for slow motion
    """
    chosen = _given(channels=channels, joints=joints, start=start, stop=stop, over=over)
    paths, ending = figure_paths(output, names, form)
    if chosen and not names:
        raise Stopped(f"--{next(iter(chosen))} chooses what a figure shows; name the figure.")
    check_ends(start, stop)
    by_impacts = impact_to_impact or None
    pace = _given(rate=rate, frames_per_second=frames_per_second, impact_to_impact=by_impacts)
    page = page_of(options).given()
    shown = {"joint": listed(joints) or (), "start": start, "stop": stop, **page}
    with ExitStack() as stack:
        job = stack.enter_context(job_of(results, url))
        beneath = None if over is None else stack.enter_context(job_of(over, url))
        stack.enter_context(refused_as_typed(*SHOWN))
        check_start(job, start)
        if is_film(names, ending, pace):
            for name, it in (("channels", "them"), ("over", "it")):
                if name in chosen:
                    raise Stopped(f"--{name}: a film shows none; leave {it} out.")
            drawn = Drawn(draw_film(job, paths, ending or "gif", **shown, **pace), [])
        else:
            shown |= {"channel": listed(channels) or (), "over": beneath}
            drawn = draw_all(job, paths, names, cast("Form", ending or "png"), **shown)
    _tell(drawn, as_json=as_json)


def _given(**asked: Any) -> dict[str, Any]:
    return {name: value for name, value in asked.items() if value is not None}


class Drawn(NamedTuple):
    """Figures that were drawn, by name and path, and sentences on those that could not be."""

    written: list[dict[str, str]]
    refused: list[str]


def draw_all(
    job: "Job", paths: FigurePaths, names: list[str] | None = None, form: Form = "png", **shown: Any
) -> Drawn:
    """Draw figures of a job, by default all; one that is refused spares the rest."""
    from jointplay.client import Refused

    wanted = names or job.figures
    drawn = Drawn([], [])
    with progress("figures") as report:
        for done, name in enumerate(wanted):
            report(done / len(wanted), name)
            path = paths.path(name, form)
            try:
                content = job.figure(name, form=form, **shown).content
            except Refused as error:
                spared = (
                    ("not-drawable",) if len(wanted) == 1 else ("not-drawable", "unknown-figure")
                )
                if error.problem not in spared:
                    raise
                cause, sentence = error.fields[0] if error.fields else ("name", str(error))
                if cause != "name" and len(wanted) == 1:
                    raise
                option = "" if cause == "name" else f"--{cause.replace('_', '-')}: "
                drawn.refused.append(f"{name}: {option}{sentence}")
                continue
            write_whole(path, content)
            drawn.written.append({"name": name, "path": str(path)})
        report(1.0, "")
    return drawn


def _tell(drawn: Drawn, *, as_json: bool) -> None:
    """Name the figures that were written, and what was refused, which is bad input."""
    found = {"figures": drawn.written} | ({"refused": drawn.refused} if drawn.refused else {})
    remark(drawn.refused)
    print_result(found, [one["path"] for one in drawn.written], as_json=as_json)
    if drawn.refused:
        raise typer.Exit(Exit.BAD_INPUT)
