"""Followers on their cams, magnified: what touches where, and how far apart it is drawn."""

import numpy as np
import pytest
from test_mechanism_elements import FOLLOWERS, RADIUS, on_cam

from jointplay.figures import draw_mechanism, scene_facts
from jointplay.figures.animation.follower import FARTHEST, ROLLER, Follower
from jointplay.figures.animation.magnified import DEEPEST, GAP
from jointplay.figures.page import panels

LASH = 1e-4
LAW = {"law": "lankarani-nikravesh", "stiffness": 1e8}
POSE = {"shaft": (0.0, 0.0, 0.7), "tappet": (0.0, 0.05, 0.0)}
TURNED = {"shaft": (0.0, 0.0, 1.1), "tappet": (0.0, 0.05, 0.4)}


@pytest.mark.parametrize("pose", [POSE, TURNED], ids=["upright", "aslant"])
@pytest.mark.parametrize("shape", FOLLOWERS)
def test_a_follower_touches_an_eccentric_circle_on_the_line_to_its_centre(shape, pose):
    scene = on_cam(shape, clearance={"lash": LASH, "contact": LAW})
    columns = {
        "cam.penetration": np.array([-LASH, 0.0, 2e-6, -1.0]),
        "cam.normal_force": np.array([0.0, 0.0, 50.0, 0.0]),
    }
    follower = Follower("cam", scene, columns)
    apart = [follower.apart(at) for at in range(4)]
    assert apart == pytest.approx([GAP, 0.0, -DEEPEST, FARTHEST])
    _, ((free, axes),) = panels(1, 2, 50.0)
    follower.draw(free, 0, pose)
    follower.draw(axes, 2, pose)
    cam, moved = axes.patches
    outline = cam.get_xy()
    centre = (outline.min(axis=0) + outline.max(axis=0)) / 2.0
    # points are 1 degree apart, and the roller's path is a table of 64 knots
    drawn = (RADIUS - LASH) * GAP / (LASH * follower.magnified[0])
    np.testing.assert_allclose(np.hypot(*(outline - centre).T), drawn, rtol=1e-3)
    normal = -centre / np.hypot(*centre)
    (arrow,) = axes.texts
    assert not free.texts
    np.testing.assert_allclose(arrow.xy, -DEEPEST * normal, atol=1e-3)
    if shape == "roller":
        np.testing.assert_allclose(moved.get_center(), (ROLLER - DEEPEST) * normal, atol=1e-3)
    else:
        tilt = pose["tappet"][2]
        np.testing.assert_allclose(normal, [-np.sin(tilt), np.cos(tilt)], atol=1e-3)
        np.testing.assert_allclose(moved.get_xy()[:2] @ normal, -DEEPEST, atol=1e-3)


def test_results_of_before_that_keep_no_curves_are_drawn_without():
    scene = on_cam("flat", clearance={"lash": LASH, "contact": LAW}) | {"gears": {}}
    assert scene_facts.is_drawn(scene, "cam")
    assert not scene_facts.is_drawn(scene | {"curves": []}, "cam")
    with_cam, without = (
        len(draw_mechanism(one, POSE).axes[0].patches) for one in (scene, scene | {"curves": []})
    )
    assert with_cam == without + 1
