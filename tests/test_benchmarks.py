"""Commands of ``python -m benchmarks`` are found, tell their options, and refuse others."""

import importlib
import inspect
import sys

import pytest

from benchmarks.__main__ import ALL


@pytest.mark.parametrize("name", ALL)
def test_a_command_is_found_and_refuses_an_option_that_it_does_not_have(name, monkeypatch, capsys):
    command = importlib.import_module(f"benchmarks.{name}").main
    program = inspect.getsource(sys.modules[command.__module__])
    if "sys.argv" not in program and "argparse" not in program:
        return  # it has no options
    for option, status in (("--help", "0"), ("--no-such-option", "2")):
        monkeypatch.setattr(sys, "argv", [name, option])
        with pytest.raises(SystemExit, match=status):
            command()
    told = capsys.readouterr()
    assert "--help" in told.out
    assert "unrecognized arguments: --no-such-option" in told.err
