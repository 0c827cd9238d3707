"""The command starts fast because it loads nothing before it is needed, and ends at once."""

import gc
import subprocess
import sys

import pytest

from jointplay.command_line import application, main

HEAVY = ["numba", "scipy", "matplotlib", "celery", "sqlalchemy", "fastapi", "zarr", "numpy"]
HEAVY += ["pydantic", "httpx", "rich"]


def loaded_by(*arguments: str) -> set[str]:
    program = (
        "import sys\n"
        "from jointplay.command_line.application import run\n"
        "run(sys.argv[1:])\n"
        f"print('loaded:', *(name for name in {HEAVY} if name in sys.modules))\n"
    )
    ended = subprocess.run(
        [sys.executable, "-c", program, *arguments], capture_output=True, text=True, check=True
    )
    (line,) = [line for line in ended.stdout.splitlines() if line.startswith("loaded:")]
    return set(line.removeprefix("loaded:").split())


def test_help_loads_nothing_but_the_help():
    assert loaded_by("--help") <= {"rich"}


@pytest.mark.parametrize("arguments", [["scene", "list"], ["scene", "show", "pendulum"]])
def test_presets_are_shown_without_a_compiler_or_a_database(arguments):
    assert loaded_by(*arguments) <= {"pydantic", "numpy", "rich"}


def test_a_client_command_loads_no_service():
    assert loaded_by("ls", "--url", "http://127.0.0.1:9").isdisjoint(
        {"numba", "celery", "fastapi", "zarr", "matplotlib", "sqlalchemy"}
    )


def test_it_ends_without_a_look_at_what_is_still_there(monkeypatch):
    monkeypatch.setattr(application, "run", lambda: 3)
    try:
        with pytest.raises(SystemExit) as ended:
            main()
        assert ended.value.code == 3
        assert gc.get_freeze_count() > 10_000
    finally:
        gc.unfreeze()
