"""Films of a run: GIF, and MP4 or WebM where there is ffmpeg."""

from collections.abc import Callable
from pathlib import Path

from jointplay.figures import page
from jointplay.figures.adjustment import adjust
from jointplay.figures.animation.gif import gif
from jointplay.figures.animation.instants import instants
from jointplay.figures.animation.pace import Pace
from jointplay.figures.animation.picture import DOTS_PER_INCH, picture
from jointplay.figures.animation.reel import Reel, channels
from jointplay.figures.animation.still import ANIMATION
from jointplay.figures.animation.video import video
from jointplay.figures.kind import NotDrawable, Selection
from jointplay.figures.options import Options
from jointplay.figures.quantity import showing
from jointplay.records.figure_form import FILM_FORMS
from jointplay.records.run import Source
from jointplay.records.whole_file import whole


def film(
    source: Source,
    path: Path,
    selection: Selection | None = None,
    options: Options | None = None,
    pace: Pace | None = None,
    report: Callable[[float], object] = lambda share: None,
) -> None:
    """Write a film; whatever goes wrong or interrupts it leaves the file's name as it was.

    Parameters
    ----------
    source
        Results of a run.
    path
        Of the file, which is written anew; ends in .gif, .mp4 or .webm.
    selection
        Joints to magnify and the window of time, by default the first turn of the drivers.
    options
        Of its page.
    pace
        How fast it goes.
    report
        Called with the share that is done.

    Raises
    ------
    NotDrawable
        The source lacks what it is drawn from, the film would be too long, an option means nothing
        for it, or there is no ffmpeg, or it failed.
    """
    selection, options, pace = selection or Selection(), options or Options(), pace or Pace()
    if path.suffix.removeprefix(".") not in FILM_FORMS:
        raise NotDrawable(f"{path}: the name of a film ends in .gif, .mp4 or .webm.", "path")
    writer = gif if path.suffix == ".gif" else video
    ANIMATION.check(selection)
    channels(source, selection)
    with (
        page.style(options.font, options.font_size),
        showing(options.shown_units),
        whole(path) as partial,
        writer(partial, pace.frames_per_second) as add,
    ):
        reel = Reel(source, selection, instants(source, selection, pace))
        adjust(reel.figure, options)
        reel.figure.set_dpi(DOTS_PER_INCH)
        reel.figure.draw_without_rendering()
        reel.figure.set_layout_engine("none")  # or frames would tremble
        for frame in range(len(reel)):
            reel.show(frame)
            add(picture(reel.figure))
            report((frame + 1) / len(reel))
