"""Tiles as PNG pictures of indexed colours."""

import io
from collections.abc import Callable

import numpy as np
from PIL import Image

from jointplay.records.arrays import Floats
from jointplay.records.coarse_to_fine import TILE
from jointplay.records.motion import Labels

CLEAR = 0
"""Index of what is not known: it is transparent."""
SHADES = (
    "#00224e",
    "#123570",
    "#3b496c",
    "#575d6d",
    "#707173",
    "#8a8678",
    "#a59c74",
    "#c3b369",
    "#fee838",
)
"""Colours of values from low to high: samples of matplotlib's cividis, even to all eyes."""


def picture_of_labels(labels: Labels, colour_of: Callable[[int], str]) -> bytes:
    """Return the PNG of labels, (height, width), whose first row is the lowest."""
    return _png(labels, "".join(colour_of(label)[1:] for label in range(256)))


def picture_of_values(values: Floats, low: float, high: float) -> bytes:
    """Return the PNG of values, (height, width), dark at `low` and light at `high`."""
    span = high - low if high > low else 1.0
    shares = np.clip((values - low) / span, 0.0, 1.0)
    steps = np.where(np.isfinite(values), 1.0 + np.rint(254.0 * shares), float(CLEAR))
    anchors = np.array([list(bytes.fromhex(one[1:])) for one in SHADES], np.float64)
    places = np.linspace(0.0, len(SHADES) - 1.0, 255)
    mixed = [np.interp(places, np.arange(len(SHADES)), part) for part in anchors.T]
    shades = np.rint(np.stack(mixed, axis=1)).astype(np.uint8).tobytes().hex()
    return _png(np.nan_to_num(steps).astype(np.uint8), "000000" + shades)


def _png(indices: Labels, palette: str) -> bytes:
    """Return a tile; what lies beyond the chart is clear."""
    tile = np.full((TILE, TILE), CLEAR, np.uint8)
    height, width = indices.shape
    tile[:height, :width] = indices
    picture = Image.fromarray(np.ascontiguousarray(tile[::-1]), "L")
    picture.putpalette(bytes.fromhex(palette))
    into = io.BytesIO()
    picture.save(into, "PNG", transparency=CLEAR, compress_level=1)
    return into.getvalue()
