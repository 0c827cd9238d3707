"""The store of a job in one file: from the API, and from a bucket to which the API leads."""

import logging
import subprocess
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import httpx
import numpy as np
import obstore
import pytest
import xarray
from obstore.store import HTTPStore

from jointplay.service.app import create_app
from jointplay.service.zarr import whole
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.packed import Packed
from jointplay.storage.settings import Settings
from tests.seaweedfs_server import BUCKET, running_store
from tests.service.guarded import Guarded
from tests.service_in_thread import serving
from tests.waiting import until
from tests.worker_by_hand import Worker

get = partial(httpx.get, trust_env=False)


@pytest.fixture(scope="module")
def in_bucket(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Guarded, str]]:
    """A service that leads to its bucket, and the address of that."""
    with running_store() as endpoint, pytest.MonkeyPatch.context() as patch:
        patch.setattr(whole, "_LARGE", 1000)  # that a small job is sent as a large one would be
        settings = Settings(
            data=tmp_path_factory.mktemp("data"),
            results_url=f"s3://{BUCKET}/whole?endpoint={endpoint}",
            results_redirect=endpoint,
            running="data",
            keys="required",
        )
        with serving(create_app(settings)) as url:
            catalogue = Catalogue(settings.catalogue_url)
            catalogue.migrate()
            found = Guarded(url, catalogue, "", "")
            with found.as_("ada") as http:
                found.job = Worker(http, catalogue, settings).finished()
            yield found, endpoint
            catalogue.close()


def by_curl(address: str, key: str = "") -> bytes:
    header = ["-H", f"Authorization: Bearer {key}"] if key else []
    command = ["curl", "-sSfL", "--noproxy", "*", *header, address]
    return subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout


def test_a_file_is_sent_to_its_end_though_its_job_is_deleted_meanwhile(
    http: httpx.Client, finished_job: str, settings: Settings, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The answer ended too early, and the log had tracebacks."""
    (file,) = Path(settings.results_url.removeprefix("file:")).glob(f"*/{finished_job}-*.zip")
    content, check = file.read_bytes(), Packed.check

    def deleted_once_checked(packed: Packed, start: int, stop: int) -> None:
        check(packed, start, stop)
        file.unlink()

    monkeypatch.setattr(Packed, "check", deleted_once_checked)
    try:
        for asked, part in (("bytes=0-", slice(None)), ("bytes=100-", slice(100, None))):
            headers = {"Range": asked}
            answer = http.get(f"/v1/jobs/{finished_job}/zarr.zip", headers=headers)
            assert (answer.status_code, answer.content) == (206, content[part])
            file.write_bytes(content)
    finally:
        file.write_bytes(content)


@pytest.mark.parametrize(
    "fault", [ConnectionError("the store is away"), FileNotFoundError("it was removed")]
)
def test_a_file_that_cannot_be_read_to_its_end_is_cut_off_with_a_line_in_the_log(
    fault: OSError,
    http: httpx.Client,
    finished_job: str,
    monkeypatch: pytest.MonkeyPatch,
    caplog: pytest.LogCaptureFixture,
) -> None:
    """The client sees that bytes are missing; the log had tracebacks."""
    (size, held) = (int(http.head(address(finished_job)).headers["Content-Length"]), whole._held)

    class OfBucket:
        """A sealed store, of which nothing can be read any more once a piece of it was sent."""

        def __init__(self, sealed: StoredObject) -> None:
            self.source, self.sent = held(sealed), False

        def __getattr__(self, name: str) -> Any:
            return getattr(self.source, name)

        def read(self, start: int, stop: int) -> bytes:
            if self.sent:
                raise fault
            self.sent = (start, stop) == (0, 1000)
            return self.source.read(start, stop)

    monkeypatch.setattr(whole, "_held", OfBucket)
    monkeypatch.setattr(whole, "_PIECE", 1000)
    for log in ("uvicorn.error", "jointplay"):
        monkeypatch.setattr(logging.getLogger(log), "handlers", [caplog.handler])
    with pytest.raises(httpx.RemoteProtocolError, match=f"received 1000 bytes, expected {size}"):
        http.get(address(finished_job))
    until(lambda: "without completing" in caplog.text)  # uvicorn's own line
    assert f"zarr.zip: the answer ended too early: {fault}" in caplog.text
    assert "Traceback" not in caplog.text
    monkeypatch.undo()
    assert len(http.get(address(finished_job)).content) == size


def address(job_id: str) -> str:
    return f"/v1/jobs/{job_id}/zarr.zip"


def test_the_file_and_its_ranges(guarded: Guarded, tmp_path: Path) -> None:
    with guarded.as_("ada") as ada:
        address = f"/v1/jobs/{guarded.job}/zarr.zip"
        all_of_it = ada.get(address)
        assert all_of_it.status_code == 200
        size = len(all_of_it.content)
        head = ada.head(address)
        assert (int(head.headers["Content-Length"]), head.content) == (size, b"")
        for asked, part in (("bytes=5-9", slice(5, 10)), ("bytes=-7", slice(size - 7, size))):
            answer = ada.get(address, headers={"Range": asked})
            assert (answer.status_code, answer.content) == (206, all_of_it.content[part])
        assert ada.get(address, headers={"Range": f"bytes={size}-"}).status_code == 416
        tag = {"If-None-Match": all_of_it.headers["ETag"]}
        assert ada.get(address, headers=tag).status_code == 304
        queued = Worker(ada, guarded.catalogue, Settings(data=tmp_path)).submit()
        assert ada.get(f"/v1/jobs/{queued}/zarr.zip").status_code == 409
        root = ada.get(f"/v1/jobs/{guarded.job}/zarr/zarr.json").content
    (tmp_path / "store.zip").write_bytes(all_of_it.content)
    with ZipFile(tmp_path / "store.zip") as stored:
        assert stored.read("zarr.json") == root
    assert get(f"{guarded.url}{address}").status_code == 401
    with guarded.as_("bob") as bob:
        assert bob.get(address).status_code == 404


def test_stock_clients_follow_to_the_bucket_and_read_equal_values(
    in_bucket: tuple[Guarded, str], tmp_path: Path
) -> None:
    service, endpoint = in_bucket
    key = service.key("ada")
    headers = {"Authorization": f"Bearer {key}"}
    job = f"{service.url}/v1/jobs/{service.job}"
    link = httpx.post(f"{job}/links", headers=headers, trust_env=False).json()["zarr"]
    signed = f"{service.url}{link}"
    answer = get(f"{signed}.zip")
    assert answer.status_code == 307
    assert answer.headers["Location"].startswith(f"{endpoint}/")
    assert get(answer.headers["Location"].replace("zarr.zip", "other.zip")).status_code == 403
    content = by_curl(f"{job}/zarr.zip", key)
    store = HTTPStore(signed.rpartition("/")[0], client_options={"allow_http": True})
    assert bytes(obstore.get_range(store, "zarr.zip", start=100, end=900)) == content[100:900]
    (tmp_path / "store.zip").write_bytes(content)
    ways: dict[str, Callable[[], xarray.Dataset]] = {
        "header": partial(
            xarray.open_zarr,
            f"{job}/zarr",
            storage_options={"client_kwargs": {"headers": headers}},
        ),
        "signed link": partial(xarray.open_zarr, signed),
        "downloaded": partial(xarray.open_zarr, f"zip::{tmp_path / 'store.zip'}"),
        "redirected": partial(xarray.open_zarr, f"zip::{signed}.zip"),
    }
    values = {name: opened()["slider7.x"].to_numpy() for name, opened in ways.items()}
    for name, found in values.items():
        assert len(found) > 1000, name
        np.testing.assert_array_equal(found, values["header"], err_msg=name)
