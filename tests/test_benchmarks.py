"""Commands of ``python -m benchmarks`` are found, tell their options, and refuse others."""

import importlib
import sys

import pytest

from benchmarks.__main__ import ALL, has_options, main


@pytest.mark.parametrize("name", ALL)
def test_a_command_is_found_and_refuses_an_option_that_it_does_not_have(name, monkeypatch, capsys):
    command = importlib.import_module(f"benchmarks.{name}").main
    if not has_options(command):
        monkeypatch.setattr(sys.modules[command.__module__], "main", pytest.fail)
        for option, status in (("--help", 0), ("--no-such-option", 2)):
            monkeypatch.setattr(sys, "argv", ["benchmarks", name, option])
            assert main() == status
            assert f"{name} has no options." in capsys.readouterr().out
        return
    for option, status in (("--help", "0"), ("--no-such-option", "2")):
        monkeypatch.setattr(sys, "argv", [name, option])
        with pytest.raises(SystemExit, match=status):
            command()
    told = capsys.readouterr()
    assert "--help" in told.out
    assert "unrecognized arguments: --no-such-option" in told.err


def test_help_without_a_name_runs_nothing(monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["benchmarks", "--help"])
    assert main() == 0
    assert "extremes, drafts" in capsys.readouterr().out
