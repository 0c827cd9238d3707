"""Help on a terminal of 80 columns: nothing of it is cut off, and sentences have room."""

import pytest

from jointplay.command_line.application import COMMANDS

EVERY = [*((name,) for name in COMMANDS), ("key", "new"), ("scene", "check"), ("scene", "draw")]


@pytest.mark.parametrize("command", EVERY, ids=" ".join)
def test_nothing_of_the_help_is_cut_off(jointplay, command, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    shown = jointplay(*command, "--help").out
    assert "…" not in shown
    assert max(map(len, shown.splitlines())) <= 80
    assert "-h, --help" in shown


def test_sentences_about_options_have_half_of_the_line(jointplay, monkeypatch):
    """They had 17 columns beside those of the names; choices were cut off."""
    monkeypatch.setenv("COLUMNS", "80")
    shown = jointplay("run", "--help").out
    assert "--samples-per-period INTEGER" in shown
    assert "root_mean_square, standard_deviation," in shown
    assert "repeat it for every\n" in shown
    monkeypatch.setenv("COLUMNS", "140")
    assert "╭─ Options" in jointplay("run", "--help").out
