import time

import pytest

from jointplay.records.channel_choice import NoSuchChannel, choose
from jointplay.records.suggestions import did_you_mean

NAMES = ["crank.x", "crank.y", "A.normal_force", "energy.kinetic"]


def test_no_list_means_all_channels():
    assert choose(None, NAMES) == NAMES


@pytest.mark.parametrize(
    ("text", "chosen"),
    [
        ("crank.y,crank.x", ["crank.y", "crank.x"]),
        (" crank.x , crank.x ", ["crank.x"]),
        ("crank.*", ["crank.x", "crank.y"]),
        ("*.?", ["crank.x", "crank.y"]),
        ("*", NAMES),
        ("energy.kinetic, crank.*,crank.x", ["energy.kinetic", "crank.x", "crank.y"]),
    ],
)
def test_names_and_globs_choose_in_their_own_order(text, chosen):
    assert choose(text, NAMES) == chosen


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("crank.X", "did you mean crank"),
        ("rotor.x,crank.x", "'rotor.x'"),
        ("zzz", "there are crank.x, crank.y"),
        ("", "empty"),
        (" , ", "empty"),
        ("CRANK.*", "no channel"),
    ],
)
def test_what_matches_nothing_is_named(text, says):
    with pytest.raises(NoSuchChannel, match=says.replace("*", r"\*")):
        choose(text, NAMES)


BODY = [f"rocker.{one}" for one in ["x", "y", "theta", "vx", "vy", "omega", "ax", "ay", "alpha"]]
JOINT = [f"B.{one}" for one in ("force_x", "force_y", "normal_force", "slip_velocity")]


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("rocker.angle", ["rocker.theta"]),
        ("rocker.angular_velocity", ["rocker.omega"]),
        ("rocker.Angle", ["rocker.theta"]),
        ("rocker.velocity", ["rocker.vx", "rocker.vy"]),
        ("rocker.acceleration_y", ["rocker.ay"]),
        ("B.contact_force", ["B.normal_force"]),
        ("B.normal_forse", ["B.normal_force"]),
    ],
)
def test_a_quantity_by_another_term_is_the_one_that_was_meant(name, meant):
    said = f"There is no channel '{name}'; did you mean {' or '.join(meant)}?"
    quoted = " or ".join(f"'{one}'" for one in meant)
    assert did_you_mean(name, BODY + JOINT) == f"did you mean {quoted}?"
    with pytest.raises(NoSuchChannel) as caught:
        choose(name, BODY + JOINT)
    assert str(caught.value).startswith(said.removesuffix("?"))


def test_many_names_are_looked_up_and_globs_are_few():
    names = [f"body{k}.x" for k in range(2000)]
    assert choose(",".join(names), names) == names
    with pytest.raises(NoSuchChannel, match="501 globs; give at most 500"):
        choose(",".join(f"*{k}" for k in range(501)), names)


def test_a_hostile_list_is_refused_quickly():
    names = [f"body{index}.x" for index in range(100)]
    hostile = ",".join(f"b{index}.x" for index in range(5000)) + "," + "*a" * 5000
    start = time.perf_counter()
    with pytest.raises(NoSuchChannel) as caught:
        choose(hostile, names)
    assert len(caught.value.sentences) == 20
    # half a million matches take about 1 s here, 5000 suggestions would take a minute
    assert time.perf_counter() - start < 20.0
