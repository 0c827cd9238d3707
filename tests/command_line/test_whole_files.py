"""Files that commands write: an interruption or a full disk leaves the one before."""

import errno
import subprocess
import sys
from pathlib import Path

import pytest

from jointplay.command_line.application import run
from jointplay.command_line.exits import Exit
from jointplay.local import load

BEFORE = b"what was there before"
COMMANDS = {
    "compare RUN RUN": "both.svg",
    "plot RUN angle": "angle.svg",
    "scene draw pendulum": "drawn.png",
    "scene schema": "scene.schema.json",
    "openapi": "openapi.json",
    "accuracy pendulum --duration 0.2": "costs.json",
    "accuracy pendulum --duration 0.1": "costs.pdf",
}


@pytest.fixture(scope="module")
def computed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("runs") / "run"
    assert run(["run", "pendulum", "--duration", "0.5", "-o", str(folder)]) == 0
    return folder


@pytest.fixture
def full(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder on a disk that is full after half of whatever is written there at once."""
    real = {"write_bytes": Path.write_bytes, "write_text": Path.write_text}

    def half(name: str):
        def write(path, content, *more, **others):
            if path.parent != tmp_path:
                return real[name](path, content, *more, **others)
            real[name](path, content[: len(content) // 2], *more, **others)
            raise OSError(
                errno.ENOSPC, "No space left on device"
            )  # as a write does: without a name

        return write

    for name in real:
        monkeypatch.setattr(Path, name, half(name))
    return tmp_path


@pytest.mark.parametrize("command", COMMANDS)
def test_a_full_disk_leaves_the_file_before(jointplay, computed, full, command):
    """Half of the new one was there, and looked like all of it."""
    output = full / COMMANDS[command]
    with output.open("wb") as file:
        file.write(BEFORE)
    ended = jointplay(*command.replace("RUN", str(computed)).split(), "-o", output)
    told = ended.err.splitlines()[-1]
    assert told == f"jointplay: {output} is full; make room and try again."
    assert ended.code == Exit.FAILED
    assert [(one.name, one.read_bytes()) for one in full.iterdir()] == [(output.name, BEFORE)]


def test_a_full_disk_leaves_the_picture_before(computed, full):
    output = full / "angle.png"
    with output.open("wb") as file:
        file.write(BEFORE)
    picture = load(computed).figure("angle")
    with pytest.raises(OSError, match="No space"):
        picture.save(output)
    assert [(one.name, one.read_bytes()) for one in full.iterdir()] == [(output.name, BEFORE)]


def test_what_is_no_file_is_written_to():
    """A pipe has no name beside its own."""
    command = [sys.executable, "-m", "jointplay", "scene", "schema"]
    printed = subprocess.run(command, capture_output=True, check=True).stdout
    written = subprocess.run([*command, "-o", "/dev/stdout"], capture_output=True, check=True)
    assert written.stdout.startswith(printed)
