"""An object store from outside: one SQLite file, one class and one registry line."""

import math
import sqlite3
from collections.abc import Iterable, Iterator
from contextlib import closing
from hashlib import sha256
from pathlib import Path

import numpy as np
import pytest
import xarray

from jointplay.client import Client
from jointplay.service.app import create_app
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.installation import MARK
from jointplay.storage.object_stores import OBJECT_STORES, ObjectStore
from jointplay.storage.settings import Settings
from tests.seams.conftest import Platform
from tests.service_in_thread import serving
from tests.storage.object_stores.contract import ObjectStoreContract

SWING = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 2.0}
SWEEP = {
    "kind": "sweep",
    "scene": {"preset": "slider-crank"},
    "grid": {"clearance": [1e-4, 2e-4]},
    "periods": 1,
}


class OneDatabase:
    """Objects as rows of a table; a transaction makes them appear whole."""

    def __init__(self, path: str) -> None:
        self.path = path
        Path(path).parent.mkdir(parents=True, exist_ok=True)
        self.ask("CREATE TABLE IF NOT EXISTS objects (key TEXT PRIMARY KEY, content BLOB)")

    def ask(self, statement: str, *values: object) -> list[tuple[bytes]]:
        """Run one statement in a transaction of its own."""
        with closing(sqlite3.connect(self.path, timeout=60)) as database, database:
            return database.execute(statement, values).fetchall()

    @property
    def largest(self) -> float:
        return math.inf

    def put(self, key: str, pieces: Iterable[bytes]) -> None:
        try:
            self.ask("INSERT INTO objects VALUES (?, ?)", key, b"".join(pieces))
        except sqlite3.IntegrityError as error:
            raise FileExistsError(key) from error

    def link(self, key: str, endpoint: str, seconds: float, *, method: str = "GET") -> str | None:
        return None

    def entity_tag(self, key: str) -> str | None:
        return None

    def replace(self, key: str, pieces: Iterable[bytes]) -> None:
        self.ask("INSERT OR REPLACE INTO objects VALUES (?, ?)", key, b"".join(pieces))

    def size(self, key: str) -> int:
        return len(self._content(key))

    def version(self, key: str) -> str | None:
        try:
            return sha256(self._content(key)).hexdigest()
        except FileNotFoundError:
            return None

    def read(self, key: str, start: int, stop: int) -> bytes:
        return self._content(key)[start:stop]

    def list(self, prefix: str) -> Iterator[str]:
        rows = self.ask("SELECT key FROM objects WHERE substr(key, 1, ?) = ?", len(prefix), prefix)
        return (str(key) for (key,) in rows)

    def cut_off(self, prefix: str) -> Iterator[str]:
        return iter(())

    def remove(self, prefix: str) -> None:
        self.ask("DELETE FROM objects WHERE substr(key, 1, ?) = ?", len(prefix), prefix)

    def adopt(self, key: str, lost: str) -> bool:
        self.ask(
            "INSERT OR IGNORE INTO objects SELECT ?, content FROM objects WHERE key = ?", key, lost
        )
        return bool(self.ask("SELECT key FROM objects WHERE key = ?", lost))

    def _content(self, key: str) -> bytes:
        rows = self.ask("SELECT content FROM objects WHERE key = ?", key)
        if not rows:
            raise FileNotFoundError(key)
        return bytes(rows[0][0])


class TestOneDatabase(ObjectStoreContract):
    """It does what every object store must."""

    @pytest.fixture
    def object_store(self, tmp_path: Path) -> ObjectStore:
        return OneDatabase(str(tmp_path / "results.sqlite"))

    def raw_get(self, object_store: ObjectStore, key: str) -> bytes | None:
        assert isinstance(object_store, OneDatabase)
        rows = object_store.ask("SELECT content FROM objects WHERE key = ?", key)
        return rows[0][0] if rows else None

    def raw_set(self, object_store: ObjectStore, key: str, content: bytes) -> None:
        assert isinstance(object_store, OneDatabase)
        object_store.ask("INSERT OR REPLACE INTO objects VALUES (?, ?)", key, content)


@pytest.fixture(scope="module")
def platform(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Platform]:
    """A service whose settings name the new object store."""
    data = tmp_path_factory.mktemp("data")
    OBJECT_STORES["sqlite"] = OneDatabase
    try:
        settings = Settings(data=data, results_url=f"sqlite:{data}/results.sqlite")
        with serving(create_app(settings)) as url, Client(url) as client:
            catalogue = Catalogue(settings.catalogue_url)
            yield Platform(client, catalogue, settings)
            catalogue.close()
    finally:
        del OBJECT_STORES["sqlite"]


def test_a_simulation_is_stored_there_and_read_from_there(platform: Platform) -> None:
    job = platform.computed(SWING)
    assert job.state == "succeeded"
    stored = {*platform.settings.object_store.list("")} - {MARK}
    assert stored == {platform.settings.sealed_run(job.id, 1).key}
    assert not (platform.settings.data / "results").exists()
    window = job.window("rod.theta")
    opened = job.open()  # every chunk over HTTP, by a stock Zarr client
    np.testing.assert_array_equal(opened["rod.theta"], window["rod.theta"])
    np.testing.assert_array_equal(opened["time"], window.time)
    assert isinstance(opened, xarray.Dataset)
    assert job.peaks.loc["rod.theta", "maximum"] >= float(window["rod.theta"].max())


def test_so_is_a_study(platform: Platform) -> None:
    job = platform.computed(SWEEP)
    assert job.state == "succeeded"
    assert platform.settings.sealed_study(job.id).exists()
    assert not platform.settings.running_folder(job.id).exists()
    assert job.points["status"].tolist() == ["done", "done"]


def test_results_go_with_their_job(platform: Platform) -> None:
    job = platform.computed(SWING | {"duration": 1.0})
    sealed = platform.settings.sealed_run(job.id, 1)
    assert sealed.exists()
    sealed.object_store.remove(platform.settings.results_prefix(job.id))
    assert not sealed.exists()
