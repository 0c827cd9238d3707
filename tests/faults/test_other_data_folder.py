"""Two data folders, or buckets, on one catalogue: the second one is refused."""

import os
import shutil
import sqlite3
import subprocess
import sys
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from tempfile import TemporaryDirectory

import httpx
import pytest

from jointplay.service.processes import StartFailed, running_service
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.installation import MARK, OtherFiles, require_own_files, require_reachable
from jointplay.storage.settings import Settings
from tests.postgresql_server import running_server
from tests.seaweedfs_server import BUCKET, running_store

ROOT = Path(__file__).resolve().parents[2]


def test_a_service_with_another_data_folder_does_not_start(tmp_path: Path) -> None:
    first, second = tmp_path / "first", tmp_path / "second"
    with running_service(first, workers=0):
        pass
    shared = {"JOINTPLAY_CATALOGUE_URL": Settings(data=first).catalogue_url}
    with (
        pytest.raises(StartFailed, match="new to this catalogue") as refused,
        running_service(second, workers=0, environment=shared),
    ):
        pass
    assert 'File "' not in str(refused.value)  # of a traceback
    own = {"JOINTPLAY_DATA": str(second), "JOINTPLAY_REDIS_URL": "redis://127.0.0.1:9/0"}
    for program in ("relay", ""):
        command = [sys.executable, "-P", "-m", f"jointplay.worker.{program}".rstrip(".")]
        found = subprocess.run(
            command, env=os.environ | shared | own, capture_output=True, text=True, check=False
        )
        assert found.returncode != 0
        assert "does not start" in found.stderr
    with running_service(second, workers=0):  # on a catalogue of its own
        pass
    with (
        pytest.raises(StartFailed, match="of another catalogue"),
        running_service(second, workers=0, environment=shared),
    ):
        pass
    shutil.move(first, tmp_path / "moved")
    with running_service(tmp_path / "moved", workers=0):  # with the catalogue in it
        pass


def test_a_copy_that_is_made_as_the_page_says_is_served(tmp_path: Path) -> None:
    first, copy = tmp_path / ".jointplay", tmp_path / "copy"
    with running_service(first, workers=0):
        pass
    page = (ROOT / "docs/operating.md").read_text()
    copied = next(line.split()[2:-1] for line in page.splitlines() if "rsync -a" in line)
    assert f"{first.name}/results" in copied
    copy.mkdir()
    name = "catalogue.sqlite"
    with (
        closing(sqlite3.connect(first / name)) as one,
        closing(sqlite3.connect(copy / name)) as two,
    ):
        one.backup(two)
    for path in filter(Path.exists, map(tmp_path.joinpath, copied)):
        (shutil.copytree if path.is_dir() else shutil.copy)(path, copy / path.name)
    with running_service(copy, workers=0) as url:
        assert httpx.get(f"{url}/readyz", trust_env=False).status_code == 200


def test_another_folder_of_results_is_refused(tmp_path: Path) -> None:
    catalogue = Catalogue(f"sqlite:///{tmp_path / 'catalogue.sqlite'}")
    with closing(catalogue):
        catalogue.migrate()

        def checked(results: str) -> None:
            (tmp_path / "data").mkdir(exist_ok=True)
            address = f"file:{tmp_path / results}"
            require_own_files(Settings(data=tmp_path / "data", results_url=address), catalogue)

        checked("mounted")
        checked("mounted")
        (tmp_path / "not mounted").mkdir()
        with pytest.raises(OtherFiles, match="not mounted is new to this catalogue"):
            checked("not mounted")


@pytest.fixture
def other_disk(tmp_path: Path) -> Iterator[Path]:
    """Return a folder on another disk than the data folder."""
    shared_memory = Path("/dev/shm")
    if not shared_memory.is_dir() or shared_memory.stat().st_dev == tmp_path.stat().st_dev:
        pytest.skip("there is no second disk")
    with TemporaryDirectory(dir=shared_memory) as folder:
        yield Path(folder)


def test_a_disk_that_is_mounted_in_the_data_folder_is_missed(
    tmp_path: Path, other_disk: Path
) -> None:
    """Results in its place would be hidden beneath it, and those on it would seem lost."""
    settings = Settings(data=tmp_path)
    results = tmp_path / "results"
    with closing(Catalogue(settings.catalogue_url)) as catalogue:
        catalogue.migrate()
        require_own_files(settings, catalogue)  # before anything was stored
        results.symlink_to(other_disk)
        require_own_files(settings, catalogue)
        require_reachable(settings, catalogue)
        assert (other_disk / MARK).exists()
        results.unlink()
        results.mkdir()  # where the disk would be mounted
        with pytest.raises(OtherFiles, match="results is new to this catalogue"):
            require_own_files(settings, catalogue)
        with pytest.raises(ConnectionError, match=f"not mounted at .*{results}"):
            require_reachable(settings, catalogue)
        assert not [*results.iterdir()]
        shutil.copytree(other_disk, results, dirs_exist_ok=True)  # moved to the other disk
        require_own_files(settings, catalogue)
        require_reachable(settings, catalogue)


def test_another_bucket_is_refused_and_another_machine_is_not(tmp_path: Path) -> None:
    with running_server() as server, running_store() as endpoint:
        url = server.new("template0")

        def checked(data: str, prefix: str, running: str = "") -> None:
            settings = Settings(
                data=tmp_path / data,
                catalogue_url=url,
                results_url=f"s3://{BUCKET}/{prefix}?endpoint={endpoint}",
                running=running,
            )
            settings.data.mkdir(exist_ok=True)
            catalogue = Catalogue(url)
            catalogue.migrate()
            try:
                require_own_files(settings, catalogue)
            finally:
                catalogue.close()

        checked("one", "first")
        checked("two", "first")  # another machine: what jobs need is in the bucket
        with pytest.raises(OtherFiles, match="new to this catalogue"):
            checked("two", "second")
        checked("one", "first", "data")  # from now on data folders are shared, too
        with pytest.raises(OtherFiles, match=MARK):
            checked("two", "first", "data")
