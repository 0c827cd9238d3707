"""A service that cannot start says why and what helps, and leaves no traceback."""

import re
import sqlite3
from collections.abc import Callable
from pathlib import Path

import pytest

from jointplay.service.processes import StartFailed, running_service


def junk(data: Path) -> None:
    (data / "catalogue.sqlite").write_bytes(bytes(range(256)) * 32)


def newer(data: Path) -> None:
    with sqlite3.connect(data / "catalogue.sqlite") as database:
        database.execute("CREATE TABLE alembic_version (version_num TEXT)")
        database.execute("INSERT INTO alembic_version VALUES ('9999')")


def nothing(_data: Path) -> None:
    """Leave the folder empty."""


AWAY = {"JOINTPLAY_CATALOGUE_URL": "postgresql://nobody@127.0.0.1:1/none"}
NO_STORE = {
    "JOINTPLAY_RESULTS_URL": "s3://results/here?endpoint=http://127.0.0.1:1",
    "AWS_ACCESS_KEY_ID": "nobody",
    "AWS_SECRET_ACCESS_KEY": "nothing",
}


@pytest.mark.parametrize(
    ("prepare", "environment", "why"),
    [
        (junk, {}, r"the catalogue is damaged.*: file is not a database\. Put a backup .* --data"),
        (newer, {}, r"the catalogue is at revision 9999, of a newer jointplay .*; run that one"),
        (nothing, AWAY, r"the catalogue does not answer: .* refused\. Does its database run, .*\?"),
        (nothing, NO_STORE, r"the store of results does not do .* Does the store run, and .*\?"),
    ],
)
def test_why_it_does_not_start_is_one_sentence(
    tmp_path: Path, prepare: Callable[[Path], None], environment: dict[str, str], why: str
) -> None:
    """It was the path of a class, behind which the log had up to 300 lines."""
    prepare(tmp_path)
    with (
        pytest.raises(StartFailed) as failed,
        running_service(tmp_path, workers=0, environment=environment),
    ):
        pass
    told = " ".join(str(failed.value).split())
    assert re.fullmatch(f"the API ended at once: {why}", told), told
    for log in ("api", "relay"):
        assert "Traceback" not in (tmp_path / "logs" / f"{log}.log").read_text()
