"""Workers that start before the catalogue has its tables."""

import threading
from contextlib import closing
from pathlib import Path

import pytest
from celery.signals import worker_init

import jointplay.worker.tasks  # noqa: F401 - listens to the signal
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.settings import Settings
from tests.waiting import PATIENCE, until


def test_a_worker_waits_for_them_and_makes_none(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setenv("JOINTPLAY_DATA", str(tmp_path))
    starting = threading.Thread(target=worker_init.send, args=(None,), daemon=True)
    starting.start()
    until(lambda: "waiting: the catalogue" in caplog.text)
    assert starting.is_alive()
    with closing(Catalogue(Settings().catalogue_url)) as catalogue:
        catalogue.connections.make_database()
        assert not catalogue.is_migrated()
        catalogue.migrate()
    starting.join(PATIENCE)
    assert not starting.is_alive()
