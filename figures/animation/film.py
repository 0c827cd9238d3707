"""Files of films: GIF, and MP4 or WebM where there is ffmpeg."""

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Final

from jointplay.figures import page
from jointplay.figures.adjustment import adjust
from jointplay.figures.animation.instants import instants
from jointplay.figures.animation.pace import Pace
from jointplay.figures.animation.reel import Reel, channels
from jointplay.figures.animation.still import ANIMATION
from jointplay.figures.kind import NotDrawable, Selection
from jointplay.figures.options import Options
from jointplay.figures.quantity import showing
from jointplay.records.figure_form import FILM_FORMS
from jointplay.records.run import Source

if TYPE_CHECKING:
    from matplotlib.animation import AbstractMovieWriter

DOTS_PER_INCH: Final = 192
"""642 pixels across a page of 85 mm."""
_PLAYED_EVERYWHERE: Final = ["-pix_fmt", "yuv420p"]


def film(
    source: Source,
    path: Path,
    selection: Selection | None = None,
    options: Options | None = None,
    pace: Pace | None = None,
    report: Callable[[float], object] = lambda share: None,
) -> None:
    """Write a film.

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
        for it, or there is no ffmpeg.
    """
    selection, options, pace = selection or Selection(), options or Options(), pace or Pace()
    ANIMATION.check(selection)
    channels(source, selection)
    with page.style(options.font, options.font_size), showing(options.shown_units):
        writer = _writer(path, pace.frames_per_second)
        reel = Reel(source, selection, instants(source, selection, pace))
        adjust(reel.figure, options)
        reel.figure.draw_without_rendering()
        reel.figure.set_layout_engine("none")  # or frames would tremble
        with writer.saving(reel.figure, str(path), DOTS_PER_INCH):
            for frame in range(len(reel)):
                reel.show(frame)
                writer.grab_frame()
                report((frame + 1) / len(reel))


def _writer(path: Path, frames_per_second: int) -> "AbstractMovieWriter":
    """Return the writer of a file; `NotDrawable` if there is none, or not what it needs."""
    import matplotlib as mpl
    from matplotlib.animation import FFMpegWriter, PillowWriter

    if path.suffix.removeprefix(".") not in FILM_FORMS:
        raise NotDrawable(f"{path}: the name of a film ends in .gif, .mp4 or .webm.", "path")
    if path.suffix == ".gif":
        return PillowWriter(fps=frames_per_second)
    mpl.rcParams["animation.ffmpeg_path"] = _ffmpeg()
    return FFMpegWriter(fps=frames_per_second, codec="h264", extra_args=_PLAYED_EVERYWHERE)


def _ffmpeg() -> str:
    """Return the path of ffmpeg."""
    if installed := shutil.which("ffmpeg"):
        return installed
    try:
        from imageio_ffmpeg import get_ffmpeg_exe
    except ImportError:
        raise NotDrawable(
            "MP4 and WebM need ffmpeg: install it, or pip install 'jointplay[film]'."
            " A GIF needs neither.",
            "path",
        ) from None
    return str(get_ffmpeg_exe())
