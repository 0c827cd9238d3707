"""Picture of what `chart_curves` computes: the map, the closed forms, and where rows change.

python -m benchmarks.chart_curves_picture FOLDER PICTURE
"""

import sys
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.chart_curves import CURVES, SHARED, classes
from jointplay.figures import page
from jointplay.figures.saving import save
from jointplay.local import load
from jointplay.records.arrays import Floats, Integers

SHADES = ("#ffffff", "#009e73", "#56b4e9", "#7fbf3f", "#e69f00", "#8f8f8f")
NAMES = (
    "no impacts",
    "period-1, one impact",
    "period-1, several impacts",
    "period-2",
    "longer periods",
    "undecided",
)
LINES = {"grazing": "-", "fold": "--", "doubling": ":"}
ROWS = {"forward": ("o", "upwards"), "backward": ("x", "downwards")}
MILLI = 1e3


def shown(data: Any) -> Integers:
    """Return (amplitude, speed) positions in `NAMES`."""
    strikes, once = classes(data)
    period = data.transpose("speed", "amplitude")["period"].values
    found = np.select([period == 1.0, period == 2.0, period > 0.0], [2, 3, 4], 5)
    return np.asarray(np.where(~strikes, 0, np.where(once, 1, found)).T, np.int64)


def changes(data: Any) -> tuple[Floats, Floats]:
    """Return speeds and amplitudes at which impacts begin or end along the rows of a chart."""
    strikes, _ = classes(data)
    row, column = np.nonzero(np.diff(strikes, axis=1))
    amplitude = data["amplitude"].values
    return data["speed"].values[row], (amplitude[column] + amplitude[column + 1]) / 2.0


def main() -> None:
    """Draw it."""
    from matplotlib.colors import BoundaryNorm, ListedColormap

    folder, picture = map(Path, sys.argv[1:3])
    data = load(folder / "refined").dataset
    speed, amplitude = data["speed"].values, MILLI * data["amplitude"].values
    figure, ((axes,),) = page.panels(1, 1, 85.0)
    shades = ListedColormap(SHADES), BoundaryNorm(np.arange(len(NAMES) + 1) - 0.5, len(NAMES))
    axes.pcolormesh(
        speed, amplitude, shown(data), cmap=shades[0], norm=shades[1], rasterized=True, zorder=0
    )
    fine = np.linspace(speed[0], speed[-1], 4000)
    for name, of in CURVES.items():
        curve = of(fine)
        there = np.where(curve.admissible, MILLI * curve.amplitude, np.nan)
        axes.plot(fine, there, color="black", linestyle=LINES[name], linewidth=0.8, label=name)
    for direction, (marker, words) in ROWS.items():
        at, place = changes(load(folder / direction).dataset)
        look: dict[str, Any] = {"marker": marker, "markersize": 2.5, "linestyle": ""}
        look |= {"color": "#d55e00", "fillstyle": "none", "markeredgewidth": 0.5}
        axes.plot(at, MILLI * place, label=f"rows {words}", **look)
    for name, shade in zip(NAMES, SHADES, strict=True):
        look = {"marker": "s", "markeredgecolor": "#8f8f8f", "linestyle": ""}
        axes.plot([], [], color=shade, markersize=3.0, label=name, **look)
    axes.set_xlim(speed[0], speed[-1])
    axes.set_ylim(amplitude[0], amplitude[-1])
    axes.set_xlabel("speed [rad/s]")
    axes.set_ylabel("amplitude [mm]")
    figure.legend(loc="outside upper center", ncols=3, fontsize=6.0)
    picture.write_bytes(save(figure, "png"))
    print(f"{SHARED['kind']} drawn: {picture}")


if __name__ == "__main__":
    main()
