"""A backup, restored with stock programs where nothing was, is the whole installation again."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import obstore
import pytest
import zarr
from zarr.storage import ZipStore

from jointplay.command_line.application import run
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.settings import Settings
from tests.postgresql_server import Server
from tests.seaweedfs_server import BUCKET, store
from tests.storage.reconciliation.installation import Installed


def copied(endpoint: str, source: str, target: str) -> dict[str, bytes]:
    """Copy all objects past our own code, and return them."""
    one, two = (
        store(endpoint, url.partition("?")[0].removeprefix(f"s3://{BUCKET}/"))
        for url in (source, target)
    )
    listed = [entry["path"] for some in obstore.list(one) for entry in some]
    found = {key: bytes(obstore.get(one, key).bytes()) for key in listed}
    for key, content in found.items():
        obstore.put(two, key, content)
    return found


def arrays_in(content: bytes, path: Path) -> dict[str, np.ndarray]:
    path.write_bytes(content)
    with ZipStore(path, mode="r") as opened:
        root = zarr.open_group(opened, mode="r")
        return {
            name: np.asarray(one[...])
            for name, one in root.members(max_depth=None)
            if isinstance(one, zarr.Array)
        }


def test_a_dump_and_a_copy_of_the_bucket_are_the_whole_installation(
    in_servers: Installed,
    postgresql: Server,
    endpoint: str,
    new_address: Callable[[], str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    in_servers.catalogue.release(f"{in_servers.jobs['running']}-0", 1)  # the service is stopped
    jobs = {job.id: job for job in in_servers.catalogue.every_job()}
    events = {job: in_servers.catalogue.events(job) for job in jobs}
    dump, url, address = tmp_path / "catalogue.dump", postgresql.new("template0"), new_address()
    postgresql.client(
        "pg_dump", "--format=custom", f"--file={dump}", in_servers.settings.catalogue_url
    )
    postgresql.client("pg_restore", f"--dbname={url}", "--exit-on-error", str(dump))
    objects = copied(endpoint, in_servers.settings.results_url, address)
    in_servers.settings.object_store.remove("")
    assert in_servers.look()

    empty = tmp_path / "elsewhere"
    monkeypatch.setenv("JOINTPLAY_CATALOGUE_URL", url)
    monkeypatch.setenv("JOINTPLAY_RESULTS_URL", address)
    code = run(["doctor", str(empty)])
    assert (code, capsys.readouterr().out) == (0, "nothing is wrong\n")
    assert not empty.exists()
    settings = Settings(data=empty)
    catalogue = Catalogue(settings.catalogue_url)
    assert {job.id: job for job in catalogue.every_job()} == jobs
    assert {job: catalogue.events(job) for job in jobs} == events
    claim = catalogue.claim_block(f"{in_servers.jobs['running']}-0", "another machine", 30.0)
    assert claim is not None
    assert claim.block.attempt == 2
    catalogue.close()
    sealed = [key for key in objects if key.endswith(".zarr.zip")]
    assert len(sealed) == 3
    for key in sealed:
        content = settings.object_store.read(key, 0, settings.object_store.size(key))
        before, after = (arrays_in(one, tmp_path / "a.zip") for one in (objects[key], content))
        assert before.keys() == after.keys()
        assert len(before) > 5
        for name, values in before.items():
            np.testing.assert_array_equal(after[name], values)
    postgresql.drop(url)
