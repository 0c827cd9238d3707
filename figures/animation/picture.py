"""A frame of a film as pixels."""

from collections.abc import Callable
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from jointplay.figures import page

Picture = npt.NDArray[np.uint8]
"""(height, width, 3) pixels: red, green, blue."""
Add = Callable[[Picture], None]
"""Takes the next frame of a film."""

DOTS_PER_INCH: Final = 192
"""642 pixels across a page of 85 mm."""


def picture(figure: page.Figure) -> Picture:
    """Draw a figure, which is laid out at `DOTS_PER_INCH`."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    canvas: Any = FigureCanvasAgg(figure)  # its stubs leave types out
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3].copy()
