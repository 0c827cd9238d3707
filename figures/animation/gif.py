"""GIFs of a film's frames."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Final

import numpy as np

from jointplay.figures.animation.picture import Add
from jointplay.figures.kind import NotDrawable

if TYPE_CHECKING:
    from PIL.Image import Image

FASTEST: Final = 50
"""Frames a second: viewers take shorter delays for a mistake, and show the film slowly."""
_UNIT: Final = 10
"""Delays are multiples of this [ms]."""


@contextmanager
def gif(path: Path, frames_per_second: int) -> Iterator[Add]:
    """Give what takes frames; the file is written when all are there.

    Raises
    ------
    NotDrawable
        A GIF cannot be so fast.
    """
    from PIL.Image import fromarray

    if frames_per_second > FASTEST:
        sentence = f"A GIF shows at most {FASTEST} frames a second; choose fewer, or mp4."
        raise NotDrawable(sentence, "frames_per_second")
    frames: list[Image] = []
    yield lambda picture: frames.append(fromarray(picture))
    # each ends where it should, to the unit: the film is as long as it should be
    ends = np.rint(np.arange(len(frames) + 1) * (1000.0 / _UNIT / frames_per_second))
    delays = (_UNIT * np.diff(ends)).astype(int).tolist()
    frames[0].save(path, save_all=True, append_images=frames[1:], duration=delays, loop=0)
