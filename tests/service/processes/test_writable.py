"""A data folder in which somebody else has run a service: what cannot be written is named."""

import os
import re
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from jointplay.service.processes import WrongSetting, serve
from jointplay.service.processes.writable import require_writable

NOBODY = 65534


@pytest.fixture
def data() -> Iterator[Path]:
    """A data folder as a service leaves it, of a user who is not root."""
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made) / "data"
        for name in ("broker", "logs", "running/AB", "results/AB"):
            (folder / name).mkdir(parents=True)
        for name in ("serve.lock", "catalogue.sqlite", "catalogue.sqlite-wal", "logs/api.log"):
            (folder / name).touch()
        if os.geteuid() == 0:
            for path in (folder.parent, folder, *folder.rglob("*")):
                os.chown(path, NOBODY, -1)
        yield folder


@contextmanager
def without_root() -> Iterator[None]:
    """Be a user who may not write everything."""
    if os.geteuid():
        yield
        return
    os.seteuid(NOBODY)
    try:
        yield
    finally:
        os.seteuid(0)


NAMES = (
    "serve.lock", "catalogue.sqlite", "catalogue.sqlite-wal", "logs/api.log", "broker", "logs",
    "running/AB", "results", "results/AB",
)  # fmt: skip


def refused(data: Path, name: str) -> str:
    """Return what a start says of a file or folder that it may read at most."""
    path = data / name
    path.chmod(0o555 if path.is_dir() else 0o444)
    with without_root(), pytest.raises(WrongSetting) as told:
        serve("127.0.0.1", 0, data, 1)
    path.chmod(0o700)
    return str(told.value)


@pytest.mark.parametrize("name", NAMES)
def test_what_cannot_be_written_is_named(data: Path, name: str) -> None:
    """The API ended at once, since "the catalogue does not answer", or jobs ran for ever."""
    with without_root():
        require_writable(data)
    said = refused(data, name)
    assert said == f"{data / name} cannot be written: its mode or its disk is read-only"


@pytest.mark.skipif(os.geteuid() != 0, reason="gives files to another user")
@pytest.mark.parametrize("name", NAMES)
def test_what_another_user_left_is_told_with_what_to_do(data: Path, name: str) -> None:
    os.chown(data / name, 0, -1)
    assert re.fullmatch(
        f"{data / name}, of user root, cannot be written, .*: chown -R {NOBODY} {data}",
        refused(data, name),
    )


def test_what_a_service_does_not_write_may_be_anybodys(data: Path) -> None:
    for name in ("notes.txt", "logs/old.gz", "results/AB/sealed.zarr.zip"):
        (data / name).touch(0o400)
    with without_root():
        require_writable(data)
        require_writable(data / "none")
