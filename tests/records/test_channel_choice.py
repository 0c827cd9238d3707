import time

import pytest

from jointplay.records.channel_choice import NoSuchChannel, choose

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


def test_a_hostile_list_is_refused_quickly():
    names = [f"body{index}.x" for index in range(100)]
    hostile = ",".join(f"b{index}.x" for index in range(5000)) + "," + "*a" * 5000
    start = time.perf_counter()
    with pytest.raises(NoSuchChannel) as caught:
        choose(hostile, names)
    assert len(caught.value.sentences) == 20
    # half a million matches take about 1 s here, 5000 suggestions would take a minute
    assert time.perf_counter() - start < 20.0
