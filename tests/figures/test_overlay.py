"""Curves of several runs over one another: their labels stay on the page."""

import numpy as np
import pytest

from jointplay.figures import overlay, page

TIME = np.linspace(0.0, 1.0, 5)


@pytest.mark.parametrize(
    "labels",
    [
        ["a", "b", "c", "d", "e"],
        [f"clearance={c}e-4 friction=0.1" for c in range(1, 5)],
        [
            "scene=seven-bar-press bearing_radius=0.005 youngs_modulus=2.07e+11",
            "scene=slider-crank",
        ],
        ["as long as the label of a job may be " * 5, "b"],
    ],
    ids=["short", "parameters", "scenes", "own"],
)
def test_labels_of_any_length_stay_on_the_page_and_above_the_panels(labels):
    curves = [overlay.Curve(label, "m", TIME, TIME + i) for i, label in enumerate(labels)]
    with page.style():
        figure = overlay._draw({"A.x": curves, "A.y": curves})
        figure.draw_without_rendering()
    (legend,) = figure.legends
    box, whole = legend.get_window_extent(), figure.bbox
    assert whole.x0 <= box.x0 <= box.x1 <= whole.x1
    assert figure.axes[0].bbox.y1 <= box.y0 <= box.y1 <= whole.y1
    shown = [text.get_text().replace("\n", " ") for text in legend.get_texts()]
    assert shown == [label.strip() for label in labels]
    assert figure.axes[0].bbox.height > 0.6 * page.in_font(30.0) / 25.4 * figure.dpi
