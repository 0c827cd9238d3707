"""Named points are channels where a job or the scene asks for them, and nowhere else."""

import numpy as np
import pytest

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import admit
from jointplay.solver.kinds.simulate import Admission
from jointplay.solver.scene import presets
from tests.solver.completed_runs import run

TIP = [f"rod.tip.{quantity}" for quantity in ("x", "y", "vx", "vy")]


def test_a_point_moves_as_its_body_carries_it() -> None:
    body = ["rod.x", "rod.y", "rod.theta", "rod.vx", "rod.vy", "rod.omega"]
    found = run("pendulum", 1.0, channels=[*TIP, *body])
    x, y, angle, vx, vy, spin = (found[name] for name in body)
    across, up = 0.5 * np.cos(angle), 0.5 * np.sin(angle)
    expected = x + across, y + up, vx - spin * up, vy + spin * across
    for name, values in zip(TIP, expected, strict=True):
        # a few roundings of 1 m and 5 m/s
        np.testing.assert_allclose(found[name], values, rtol=0, atol=1e-14, err_msg=name)
    # a rod on a fixed pin: its tip is twice as far out as its centre
    assert found.peaks["rod.tip.y"].minimum == pytest.approx(2.0 * found["rod.y"].min(), abs=1e-4)


def test_only_those_that_are_asked_for_are_channels_with_units() -> None:
    job = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}
    plain, asked = admit(job), admit(job | {"channels": ["rod.tip.x", "rod.tip.vy"]})
    assert isinstance(plain, Admission)
    assert isinstance(asked, Admission)
    assert not [channel.name for channel in plain.channels if "tip" in channel.name]
    assert [(c.name, c.unit) for c in asked.channels] == [("rod.tip.x", "m"), ("rod.tip.vy", "m/s")]
    assert admit(asked.job) == asked


def test_a_scene_may_record_them_itself_and_name_them() -> None:
    scene = presets.document("pendulum") | {"recorded": ["rod.tip"]}
    scene["outputs"] = [{"name": "height", "channel": "rod.tip.y"}]
    found = admit(
        {"kind": "simulate", "scene": scene, "duration": 1.0, "channels": ["h*", "rod.t*"]}
    )
    assert isinstance(found, Admission)
    names = {channel.name for channel in found.channels}
    assert names == {"height", "rod.theta", *TIP}


def test_an_output_of_a_point_that_is_not_recorded_is_told_how_it_would_be() -> None:
    scene = presets.document("pendulum")
    scene["outputs"] = [{"name": "height", "channel": "rod.tip.y"}]
    with pytest.raises(InvalidInput) as refused:
        admit({"kind": "simulate", "scene": scene, "duration": 1.0})
    (problem,) = refused.value.problems
    assert problem.pointer == "/scene/outputs/0/channel"
    assert problem.detail == "'rod.tip.y' is a channel where 'recorded' lists 'rod.tip'."


def test_a_study_may_take_them_as_observables_and_sections() -> None:
    job = {
        "kind": "bifurcation",
        "scene": {"preset": "slider-crank"},
        "parameter": "clearance",
        "values": [1e-4, 2e-4],
        "observables": ["rod.slider.vx"],
        "section": {"channel": "rod.crank.y", "value": 0.0},
    }
    assert [channel.name for channel in admit(job).observables] == ["rod.slider.vx"]


@pytest.mark.parametrize(
    ("recorded", "words"),
    [
        (["rod.tipp"], "did you mean 'tip'?"),
        (["rood.tip"], "did you mean 'rod'?"),
        (["rod.tip", "rod.tip"], "named twice"),
    ],
)
def test_what_is_no_point_is_refused_at_its_place(recorded: list[str], words: str) -> None:
    scene = presets.document("pendulum") | {"recorded": recorded}
    with pytest.raises(InvalidInput) as refused:
        admit({"kind": "simulate", "scene": scene, "duration": 1.0})
    assert refused.value.problems[0].pointer == "/scene/recorded/0"
    assert words in refused.value.problems[0].detail


def test_a_point_whose_channels_have_names_already_is_refused() -> None:
    scene = presets.document("pendulum") | {"recorded": ["rod.x"]}
    scene["bodies"]["rod"]["points"]["x"] = [0.1, 0.0]
    with pytest.raises(InvalidInput, match="give the point another name"):
        admit({"kind": "simulate", "scene": scene, "duration": 1.0})
