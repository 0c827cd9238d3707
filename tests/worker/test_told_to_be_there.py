"""A worker's process tells the catalogue that it is there, for as long as it lives."""

import os
import subprocess
import sys
from contextlib import closing
from pathlib import Path

import pytest

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.settings import Settings
from jointplay.worker import tasks
from tests.waiting import until

PRESENT = (
    "import logging; logging.basicConfig(level='DEBUG');"
    "from jointplay.worker.tasks import _be_present; _be_present()"
)


def test_it_is_known_again_after_a_restoration_of_the_catalogue(tmp_path: Path) -> None:
    settings, log = Settings(data=tmp_path), tmp_path / "log"
    own = {"JOINTPLAY_DATA": str(tmp_path), "JOINTPLAY_HEARTBEAT": "0.05"}
    with closing(Catalogue(settings.catalogue_url)) as catalogue:
        catalogue.migrate()

        def rename(old: str, new: str) -> None:
            with catalogue.connections.writing() as connection:
                connection.exec_driver_sql(f"ALTER TABLE {old} RENAME TO {new}")

        with (
            log.open("w") as told,
            subprocess.Popen(
                [sys.executable, "-P", "-c", PRESENT], env=os.environ | own, stderr=told
            ) as process,
        ):
            try:
                until(lambda: bool(catalogue.workers()))
                rename("worker", "away")
                until(lambda: "not known to be there" in log.read_text() or bool(process.poll()))
                rename("away", "worker")
                catalogue.forget_workers(catalogue.workers())
                until(lambda: bool(catalogue.workers()) or bool(process.poll()))
                assert process.poll() is None
            finally:
                process.kill()


def test_it_is_told_whatever_goes_wrong_once(monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[str] = []

    class Wrong:
        def note_worker(self, name: str, *_: object) -> None:
            told.append(name)
            if len(told) == 1:
                raise ValueError("an answer that nobody expected")
            raise SystemExit  # ends the thread

    monkeypatch.setattr(tasks, "_platform", lambda: (Settings(heartbeat=0.01), Wrong()))
    with pytest.raises(SystemExit):
        tasks._be_present()
    assert len(told) == 2
