"""The tutorial, followed word by word: its scene, its commands, and the numbers that they print."""

import csv
import json
import re
import shlex
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

from jointplay.command_line.application import run

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "tutorial.md").read_text()
BLOCK = re.compile(r"^```(json|bash|text)\n(.*?)^```", re.DOTALL | re.MULTILINE)
IDEAL = PAGE.partition("## 5.")[0]
"""Steps that compile nothing; equations with play take half a minute of processor time."""
CLOSE = 1e-2
"""Relative: what other processors may change of printed numbers. Impacts magnify their rounding,
and the instant of an extreme has half as many digits as its value."""


def merged(before: Any, patch: Any) -> Any:
    """A first block with what a second one says, which replaces or adds to it (RFC 7386)."""
    if not (isinstance(before, dict) and isinstance(patch, dict)):
        return patch
    return {**before, **{name: merged(before.get(name), value) for name, value in patch.items()}}


def said(line: str, printed: str) -> bool:
    """Whether a line is among those that were printed, its numbers within `CLOSE`."""
    wanted = line.split()
    return any(
        len(words) == len(wanted) and all(map(alike, words, wanted))
        for words in (one.split() for one in printed.splitlines())
    )


def alike(word: str, other: str) -> bool:
    try:
        return float(word) == pytest.approx(float(other), rel=CLOSE)
    except ValueError:
        return word == other


def followed(page: str, capsys: pytest.CaptureFixture[str]) -> int:
    """Do what a page says in this folder; return how many of its lines were printed."""
    scene: Any = {}
    printed = ""
    told = 0
    for language, text in BLOCK.findall(page):
        if language == "json":
            scene = merged(scene, json.loads(text))
            Path("mine.json").write_text(json.dumps(scene))
        elif language == "bash":
            printed = ""
            for command in text.splitlines():
                program, *arguments = shlex.split(command)
                assert program == "jointplay"
                assert run(arguments) == 0, command
                printed += capsys.readouterr().out
        else:
            for line in text.splitlines():
                assert said(line, printed), f"{line}\n--- not in ---\n{printed}"
                told += 1
    return told


def test_its_first_steps_print_its_numbers(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert followed(IDEAL, capsys) == 3
    assert Path("mine.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.long
def test_all_of_its_commands_print_its_numbers_and_draw_its_figures(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert followed(PAGE, capsys) == 6
    figures = {path.name for path in Path("figures").iterdir()}
    assert {"contact-force.png", "orbit.png", "swing.pdf", "bifurcation.png"} <= figures
    assert Path("kinds/bifurcation.png").read_bytes().startswith(b"\x89PNG")
    rows = list(csv.DictReader(Path("KINDS/points.csv").read_text().splitlines()))
    told = Counter(row["verdict"] for row in rows)
    assert told["periodic"] >= 22
    assert told["chaotic"] >= 4
    undecided = [row["reason"] for row in rows if row["verdict"] == "undecided"]
    assert all(re.search("settle for longer|record more|smaller tolerance", r) for r in undecided)
