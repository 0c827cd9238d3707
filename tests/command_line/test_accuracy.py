"""What accuracy costs, from the command line."""

import json

import pytest

SHORT = ("seven-bar-press", "--duration", "0.003")
"""Before any contact, where every run takes milliseconds."""


def test_every_method_is_in_the_table_and_one_is_recommended(jointplay, tmp_path):
    ended = jointplay("accuracy", *SHORT, "-o", tmp_path / "trade.svg")
    assert ended.code == 0, ended.err
    for method in ("bogacki-shampine", "tsitouras", "dormand-prince-853", "rodas", "rk4"):
        assert f"| {method} |" in ended.out
    assert ended.out.rstrip().splitlines()[-1].startswith("The default")
    assert b"<svg" in (tmp_path / "trade.svg").read_bytes()


def test_the_file_and_what_is_printed_are_the_same_document(jointplay, tmp_path):
    ended = jointplay("accuracy", *SHORT, "--json", "-o", tmp_path / "trade.json")
    assert ended.code == 0, ended.err
    printed = json.loads(ended.out)
    assert printed == json.loads((tmp_path / "trade.json").read_text())
    assert {"duration", "window", "uncertainty", "points", "advice"} <= printed.keys()


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("seven-bar-press", "--set", "clearance=0"), "Give it clearance"),
        (("seven-bar-press", "-o", "trade.pdf"), ".png, .svg or .json"),
        (("seven-bar-pres",), "seven-bar-press"),
    ],
)
def test_what_cannot_be_measured_is_said_in_one_line(jointplay, arguments, told):
    ended = jointplay("accuracy", *arguments)
    assert ended.code == 2
    assert told in ended.err
