"""Followers on their cams, magnified: on the page as in figures, and without jumps."""

from typing import Any

import numpy as np
import pytest

from jointplay.figures.animation.follower import ROLLER, Follower
from jointplay.figures.page import panels
from jointplay.solver.kinds.assembled import assembled_scene
from tests.solver.cams import CIRCLE, follower, pitch_table, valve

DRAWN = """async ([scene, poses]) => {
  const { follower } = await import('/page/mechanism/follower.js');
  const [contact, limits] = [{ penetration: 0, normal_force: 0 }, { strongest: 1, deepest: 1e-9 }];
  return poses.map((pose) => follower(scene, 'cam', pose, contact, limits).shapes);
}"""
RADIUS = 48.0
"""A roller's on the page, px."""
STEPS = np.radians(np.arange(0.0, 2.0, 0.1))
"""Angles from one point of an outline to the next but one, each a tenth of that."""


@pytest.mark.parametrize("shape", ["flat", "roller"])
def test_a_cam_turns_under_its_follower_as_in_the_figure(
    browsing: Any, service_url: str, shape: str
) -> None:
    joint = follower(shape, CIRCLE if shape == "flat" else pitch_table(12), lash=1e-4)
    scene = assembled_scene(valve(joint), is_whole=True).drawn()
    # the tappet's point is above the shaft's, wherever it is there
    poses = [{"shaft": (0.0, 0.0, 0.3 + one), "tappet": (0.0, 0.05, 0.0)} for one in STEPS]
    with browsing.page(service_url) as page:
        cams, followers = zip(*page.evaluate(DRAWN, [scene, poses]), strict=True)
    outlines = np.array([cam["points"] for cam in cams])[:, :, 2:]
    # a turn of 0.1 degrees moves nothing by more than the picture's size times 2e-3
    assert 0.0 < np.abs(np.diff(outlines, axis=0)).max() < 2e-3 * np.ptp(outlines)
    columns = {f"cam.{one}": np.zeros(len(poses)) for one in Follower.QUANTITIES}
    figure = Follower("cam", scene, columns)
    _, ((axes,),) = panels(1, 1, 50.0)
    for at, pose in enumerate(poses):
        figure.draw(axes, at, pose)
        cam, moved = axes.patches[-2:]
        there = cam.get_xy()[: len(outlines[at])] * [1.0, -1.0] * RADIUS / ROLLER
        np.testing.assert_allclose(outlines[at], there, rtol=0.0, atol=1e-9)
        if shape == "roller":
            (position,), centre = followers[at]["points"], moved.get_center()
            expected = np.array(centre) * [1.0, -1.0] * RADIUS / ROLLER
            np.testing.assert_allclose(position[2:], expected, rtol=0.0, atol=1e-9)
