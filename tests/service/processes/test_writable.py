"""A data folder in which somebody else has run a service: what cannot be written is named."""

import os
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


@pytest.mark.parametrize(
    "name",
    [
        "serve.lock", "catalogue.sqlite", "catalogue.sqlite-wal", "logs/api.log", "broker", "logs",
        "running/AB", "results", "results/AB",
    ],
)  # fmt: skip
def test_what_cannot_be_written_is_named(data: Path, name: str) -> None:
    """The API ended at once, since "the catalogue does not answer", or jobs ran for ever."""
    with without_root():
        require_writable(data)
        (data / name).chmod(0o500 if (data / name).is_dir() else 0o400)
        with pytest.raises(WrongSetting, match=f"{data / name}, of user .* chown -R") as told:
            serve("127.0.0.1", 0, data, 1)
        (data / name).chmod(0o700)
    assert "\n" not in str(told.value)


def test_what_a_service_does_not_write_may_be_anybodys(data: Path) -> None:
    for name in ("notes.txt", "logs/old.gz", "results/AB/sealed.zarr.zip"):
        (data / name).touch(0o400)
    with without_root():
        require_writable(data)
        require_writable(data / "none")
