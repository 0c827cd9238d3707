"""Results in a bucket of an S3-compatible store."""

import os
import tracemalloc
from collections.abc import Callable, Iterable
from datetime import UTC, datetime, timedelta
from urllib.parse import urlsplit

import httpx
import obstore
import pytest
from obstore.exceptions import NotFoundError

from jointplay.storage.errors import TooLarge
from jointplay.storage.object_stores import ObjectStore, object_store_at, s3, sending
from jointplay.storage.object_stores.fitness import Unfit, require_fit
from jointplay.storage.object_stores.s3 import Bucket
from jointplay.storage.object_stores.signing import address_to_put
from tests.seaweedfs_server import BUCKET, store
from tests.slow_link import slow_link
from tests.storage.object_stores.contract import CONTENT, KEY, ObjectStoreContract, pieces
from tests.storage.running_files.contract import InObjectStoreContract


class TestBucket(ObjectStoreContract):
    """The contract."""

    @pytest.fixture
    def object_store(self, new_address: Callable[[], str]) -> ObjectStore:
        return object_store_at(new_address())

    def raw_get(self, object_store: ObjectStore, key: str) -> bytes | None:
        try:
            return bytes(obstore.get(raw(object_store), key).bytes())
        except (NotFoundError, FileNotFoundError):
            return None

    def raw_set(self, object_store: ObjectStore, key: str, content: bytes) -> None:
        obstore.put(raw(object_store), key, content)


class TestRunningFiles(InObjectStoreContract):
    """Files of a running job can be kept there, too."""

    @pytest.fixture(autouse=True)
    def _begin(self, new_address: Callable[[], str]) -> None:
        self.object_store, self.prefix = object_store_at(new_address()), "running/2R/JOB"


def raw(object_store: ObjectStore) -> obstore.store.S3Store:
    assert isinstance(object_store, Bucket)
    path, _, endpoint = object_store.address.partition("?endpoint=")
    return store(endpoint, path.removeprefix(f"//{BUCKET}/"))


def test_at_an_address_to_put_at_no_other_size_and_key_is_taken(
    new_address: Callable[[], str], endpoint: str
) -> None:
    object_store, key = object_store_at(new_address()), "2R/a~b c+d.zip"
    address = object_store.link_to_put(key, endpoint, 60.0, len(CONTENT))
    assert address is not None
    other_key = address.replace("/2R/", "/2S/")
    for there, content in ((address, CONTENT + b"x"), (address, b""), (other_key, CONTENT)):
        assert httpx.put(there, content=content, trust_env=False).status_code == 403
    assert object_store.version(key) is None
    assert httpx.put(address, content=CONTENT, trust_env=False).is_success
    assert object_store.read(key, 0, len(CONTENT)) == CONTENT


def test_a_usual_port_and_capitals_are_not_signed_as_clients_do_not_send_them() -> None:
    moment = datetime(2026, 11, 26, tzinfo=UTC)
    signatures = {
        (address_to_put(endpoint, "b/k", "r", 60.0, 7, moment=moment) or "").rpartition("=")[2]
        for endpoint in ("https://s3.example", "https://S3.Example:443", "https://s3.example:443")
    }
    assert len(signatures) == 1


def test_an_object_that_memory_should_not_hold_is_stored_and_adopted(
    new_address: Callable[[], str],
) -> None:
    object_store = object_store_at(new_address())
    large = os.urandom(17 * 2**20)
    tracemalloc.start()
    object_store.put(KEY, (large[at : at + 2**20] for at in range(0, len(large), 2**20)))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 2**23  # 4 MiB and a piece, and room in which they grow
    assert object_store.size(KEY) == len(large)
    assert object_store.read(KEY, 2**24 - 5, 2**24 + 5) == large[2**24 - 5 : 2**24 + 5]
    assert object_store.adopt("2R/other", KEY)
    assert object_store.read("2R/other", 0, len(large)) == large


def through(address: str, port: int) -> Bucket:
    where, _, _ = address.removeprefix("s3:").partition("?endpoint=")
    return Bucket(f"{where}?endpoint=http://127.0.0.1:{port}")


def server_of(address: str) -> tuple[str, int]:
    parts = urlsplit(address.partition("?endpoint=")[2])
    assert parts.hostname is not None
    assert parts.port is not None
    return parts.hostname, parts.port


@pytest.mark.parametrize("size", [12 * 2**20, 2**20])
def test_a_large_object_takes_as_long_as_its_link_needs(
    new_address: Callable[[], str], monkeypatch: pytest.MonkeyPatch, size: int
) -> None:
    monkeypatch.setattr(s3, "_LIMIT", "1s")  # of other requests
    quick = {"max_retries": 0, "retry_timeout": timedelta(seconds=1)}
    monkeypatch.setattr(s3, "_RETRIES", quick)
    s3._opened.cache_clear()
    address, large = new_address(), os.urandom(size)
    with slow_link(*server_of(address), rate=size / 2) as port:
        object_store = through(address, port)
        object_store.put(KEY, [large])
        with pytest.raises(FileExistsError):
            object_store.put(KEY, [bytes(len(large))])
        assert obstore.get(raw(object_store_at(address)), KEY).bytes() == large
        object_store.replace(KEY, [large[::-1]])
    assert obstore.get(raw(object_store_at(address)), KEY).bytes() == large[::-1]


def test_a_link_that_takes_nothing_is_found_out(
    new_address: Callable[[], str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sending, "_TIMEOUT", httpx.Timeout(5.0, write=0.2, read=0.2))
    address = new_address()
    with (
        slow_link(*server_of(address), rate=0) as port,
        pytest.raises(ConnectionError, match="does not take"),
    ):
        through(address, port).put(KEY, [bytes(12 * 2**20)])
    assert list(object_store_at(address).list("")) == []


def test_what_is_larger_than_one_request_may_be_is_refused(
    new_address: Callable[[], str], monkeypatch: pytest.MonkeyPatch
) -> None:
    object_store = object_store_at(new_address())
    monkeypatch.setattr(Bucket, "largest", 2**23)
    with pytest.raises(TooLarge, match="has at most"):
        object_store.put(KEY, [bytes(2**23), b"x"])
    assert list(object_store.list("")) == []


def test_a_store_that_is_away_is_a_fault_that_may_pass(monkeypatch: pytest.MonkeyPatch) -> None:
    quick = {"max_retries": 0, "retry_timeout": timedelta(seconds=1)}
    monkeypatch.setattr(s3, "_RETRIES", quick)
    monkeypatch.setenv("AWS_ACCESS_KEY_ID", "nobody")
    monkeypatch.setenv("AWS_SECRET_ACCESS_KEY", "nothing")
    object_store = object_store_at("s3://results/away?endpoint=http://127.0.0.1:1")
    for act in (
        lambda: object_store.put(KEY, pieces()),
        lambda: object_store.size(KEY),
        lambda: object_store.version(KEY),
        lambda: object_store.read(KEY, 0, 1),
        lambda: object_store.remove(KEY),
        lambda: list(object_store.list("")),
    ):
        with pytest.raises(ConnectionError, match="does not do as asked"):
            act()


def test_wrong_keys_are_such_a_fault_too(
    new_address: Callable[[], str], monkeypatch: pytest.MonkeyPatch
) -> None:
    address = new_address()
    monkeypatch.setenv("AWS_SECRET_ACCESS_KEY", "guessed")
    with pytest.raises(ConnectionError):
        object_store_at(address).put(KEY, pieces())


@pytest.mark.parametrize("address", ["s3:", "s3:///prefix", "s3:bucket", "s3://b?secret=x"])
def test_an_address_that_is_no_bucket_is_refused(address: str) -> None:
    with pytest.raises(ValueError, match="an address is like s3://bucket"):
        object_store_at(address)


def test_a_store_that_does_what_results_need_is_fit(new_address: Callable[[], str]) -> None:
    object_store = object_store_at(new_address())
    object_store.put(KEY, pieces())
    require_fit(object_store)
    assert list(object_store.list("")) == [KEY]
    assert object_store.read(KEY, 0, 9999) == CONTENT


class Overwriting(Bucket):
    """Stands for a store that does not heed If-None-Match."""

    def put(self, key: str, pieces: Iterable[bytes]) -> None:
        self.replace(key, pieces)


class OverwritingLarge(Bucket):
    """Stands for a store that does so at signed addresses alone."""

    def put(self, key: str, pieces: Iterable[bytes]) -> None:
        content = b"".join(pieces)
        (super().put if len(content) < 2**20 else self.replace)(key, [content])


@pytest.mark.parametrize("kind", [Overwriting, OverwritingLarge])
def test_a_store_that_writes_over_objects_is_refused(
    new_address: Callable[[], str], kind: type[Bucket]
) -> None:
    object_store = kind(new_address().removeprefix("s3:"))
    with pytest.raises(Unfit, match="If-None-Match"):
        require_fit(object_store)
    assert list(object_store.list("")) == []
