"""MP4 and WebM of a film's frames, which ffmpeg writes."""

import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Final

from jointplay.figures.animation.picture import Add, Picture
from jointplay.figures.kind import NotDrawable

_EVEN: Final = "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white"
"""Padding to an even number of pixels both ways, without which some players show nothing."""
_CODEC: Final = {".mp4": ("-vcodec", "h264"), ".webm": ()}
"""By form; that of WebM is ffmpeg's choice."""


@contextmanager
def video(path: Path, frames_per_second: int) -> Iterator[Add]:
    """Give what takes frames, all of one size; ffmpeg has written the file afterwards.

    An exception between the frames ends ffmpeg at once.

    Raises
    ------
    NotDrawable
        There is no ffmpeg, or it failed.
    """
    program = _ffmpeg()
    process: subprocess.Popen[bytes] | None = None
    with tempfile.TemporaryFile() as complaints:

        def add(picture: Picture) -> None:
            nonlocal process
            if process is None:
                height, width, _ = picture.shape
                read = ("-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}")
                pace = ("-framerate", str(frames_per_second), "-i", "pipe:")
                written = (*_CODEC[path.suffix], "-vf", _EVEN, "-pix_fmt", "yuv420p", str(path))
                process = subprocess.Popen(  # noqa: S603  (no shell; the name is beside the film's)
                    [program, "-loglevel", "error", "-y", *read, *pace, *written],
                    stdin=subprocess.PIPE,
                    stdout=subprocess.DEVNULL,
                    stderr=complaints,
                    process_group=0,  # Ctrl-C is for this process, which ends ffmpeg
                )
            assert process.stdin is not None  # noqa: S101  (narrows the type)
            try:
                process.stdin.write(picture.tobytes())
            except BrokenPipeError:
                raise _failed(process, complaints) from None

        try:
            yield add
            if process is not None:
                process.communicate()
                if process.returncode:
                    raise _failed(process, complaints)
        finally:
            if process is not None:
                process.kill()  # which does nothing to one that has ended
                process.communicate()


def _failed(process: subprocess.Popen[bytes], complaints: IO[bytes]) -> NotDrawable:
    """Make the error of an ffmpeg that has given up, with the last line that it said."""
    code = process.wait()
    complaints.seek(0)
    lines = complaints.read().decode(errors="replace").strip().splitlines()
    said = f": {lines[-1].strip()}" if lines else ""
    sentence = (
        f"ffmpeg ended with code {code}{said}; make room, choose another name, or take a GIF."
    )
    return NotDrawable(sentence, "path")


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
