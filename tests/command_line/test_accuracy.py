"""The costs of accuracy, from the command line."""

import json

import pytest

from jointplay.local import load

SHORT = ("bouncing-journal", "--duration", "0.003")
"""One body before any contact: each method compiles in a second, every run takes milliseconds."""


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
        (("seven-bar-press", "--set", "clearance=0"), "positive clearance"),
        (("seven-bar-press", "-o", "trade.jpg"), ".eps or .json"),
        (("seven-bar-pres",), "seven-bar-press"),
    ],
)
def test_what_cannot_be_measured_is_said_in_one_line(jointplay, arguments, told):
    ended = jointplay("accuracy", *arguments)
    assert ended.code == 2
    assert told in ended.err


def test_a_local_run_keeps_the_study_with_its_figure(jointplay, tmp_path):
    output = tmp_path / "OUT"
    ended = jointplay("run", *SHORT, "--accuracy-study", "--figures", "-o", output)
    assert ended.code == 0, ended.err
    assert "| rodas | 1e-06 |" in ended.out
    assert [path.name for path in (output / "figures").iterdir()] == ["work-precision.png"]
    found = json.loads((output / "accuracy.json").read_text())
    assert load(output).accuracy == found
    assert jointplay("show", output).out.rstrip().endswith(found["advice"])
    again = jointplay("accuracy", output / "job.json", "--json")
    assert again.code == 0, again.err
    steps = [(one["method"], one["error"], one["steps"]) for one in found["points"]]
    repeated = json.loads(again.out)["points"]
    assert [(one["method"], one["error"], one["steps"]) for one in repeated] == steps


def test_a_study_of_another_kind_is_refused(jointplay, tmp_path):
    path = tmp_path / "job.json"
    path.write_text(json.dumps({"kind": "poincare", "scene": {"preset": "seven-bar-press"}}))
    ended = jointplay("accuracy", path)
    assert ended.code == 2
    assert "is a poincare; give one simulation" in ended.line()
