"""A store in one file is compared with its checksums before any of it is sent."""

from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest
from httpx import Client

from jointplay.service.app import create_app
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.packed import Packed
from jointplay.storage.settings import Settings
from tests.seaweedfs_server import BUCKET, running_store
from tests.service_in_thread import client_of, serving
from tests.worker_by_hand import Worker


@pytest.fixture(scope="module", params=["folder", "bucket"])
def stored(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[tuple[Client, str, StoredObject]]:
    data: Path = tmp_path_factory.mktemp("data")
    with ExitStack() as stack:
        stores = {}
        if request.param == "bucket":
            endpoint = stack.enter_context(running_store())
            stores = {"results_url": f"s3://{BUCKET}/damaged?endpoint={endpoint}"}
        settings = Settings(data=data, running="data", **stores)
        http = stack.enter_context(client_of(stack.enter_context(serving(create_app(settings)))))
        catalogue = Catalogue(settings.catalogue_url)
        stack.callback(catalogue.close)
        job = Worker(http, catalogue, settings).finished()
        yield http, job, settings.sealed_run(job, 1)


def test_no_damaged_byte_is_sent(stored: tuple[Client, str, StoredObject]) -> None:
    http, job, sealed = stored
    address = f"/v1/jobs/{job}/zarr.zip"
    content = sealed.read(0, sealed.size())
    assert http.get(address).content == content
    entries = Packed(sealed).entries
    offsets = {0: "the first header", len(content) - 40: "the directory"}
    for key in (*list(entries)[::9], list(entries)[-1]):
        offsets[entries[key].offset + entries[key].size // 2] = f"content of {key}"
        offsets[entries[key].offset - 1] = f"name of {key}"
    try:
        for offset, name in offsets.items():
            damaged = bytearray(content)
            damaged[offset] ^= 4
            sealed.object_store.replace(sealed.key, [bytes(damaged)])
            answer = http.get(address)
            assert answer.status_code == 410, name
            assert answer.json()["type"] == "/problems/damaged-results"
            if not name.startswith("the directory"):
                part = {"Range": f"bytes={offset}-{offset}"}
                assert http.get(address, headers=part).status_code == 410, name
    finally:
        sealed.object_store.replace(sealed.key, [content])
    assert http.get(address).content == content


def test_a_range_apart_from_a_damage_is_sent(stored: tuple[Client, str, StoredObject]) -> None:
    http, job, sealed = stored
    content = sealed.read(0, sealed.size())
    first, *_, last = Packed(sealed).entries.values()
    damaged = bytearray(content)
    damaged[last.offset] ^= 4
    sealed.object_store.replace(sealed.key, [bytes(damaged)])
    try:
        part = {"Range": f"bytes=0-{first.offset}"}
        answer = http.get(f"/v1/jobs/{job}/zarr.zip", headers=part)
        assert (answer.status_code, answer.content) == (206, content[: first.offset + 1])
    finally:
        sealed.object_store.replace(sealed.key, [content])
