"""A bucket of an S3-compatible store: objects are its own, put in one request each.

The store must refuse a PUT of a key that there is (If-None-Match), and list what was put at once;
`storage.object_stores.fitness` tries it. Its credentials are where other clients of S3 have them,
such as `AWS_ACCESS_KEY_ID` and `AWS_SECRET_ACCESS_KEY` in the environment.
"""

import mmap
import os
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from datetime import timedelta
from functools import lru_cache
from importlib.util import find_spec
from io import BytesIO
from typing import TYPE_CHECKING, Final, Literal
from urllib.parse import parse_qsl, urlsplit

from jointplay.storage.errors import TooLarge
from jointplay.storage.object_stores.signing import address_to_put

if TYPE_CHECKING:
    from obstore.store import RetryConfig, S3Store

_IN_MEMORY: Final = 2**22
"""Bytes of an object that is gathered in memory; of a larger one the system has the pages."""
_RETRIES: "Final[RetryConfig]" = {"max_retries": 5, "retry_timeout": timedelta(seconds=20)}
_LIMIT: Final = "120s"
"""Time for a whole request, but those that put more bytes than this; see `sending`:"""
_SHORT: Final = 2**18
_SIGNED: Final = timedelta(hours=1)
"""Time in which such a request must begin."""
_OPTIONS: Final = {"endpoint", "region"}
_ADDRESS: Final = "s3://bucket/prefix?endpoint=http://host:8333&region=us-east-1"


@dataclass(frozen=True)
class Bucket:
    """See `storage.object_stores.ObjectStore`.

    Parameters
    ----------
    address
        Behind ``s3:``, such as ``//bucket/prefix?endpoint=http://host:8333``.

    Raises
    ------
    ValueError
        The address is no such one, or obstore is not installed.
    """

    address: str
    _parts: tuple[str, str, tuple[tuple[str, str], ...]] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        if find_spec("obstore") is None:
            raise ValueError("results in S3 need obstore: pip install 'jointplay[cluster]'")
        parts = urlsplit(self.address)
        options = dict(parse_qsl(parts.query))
        if not parts.netloc or options.keys() - _OPTIONS:
            raise ValueError(f"'s3:{self.address}' is no bucket; an address is like {_ADDRESS}")
        found = parts.netloc, parts.path.strip("/"), tuple(sorted(options.items()))
        object.__setattr__(self, "_parts", found)

    @property
    def largest(self) -> float:
        """Bytes of one PUT, the most that Amazon's S3 and others take."""
        return 5e9

    def put(self, key: str, pieces: Iterable[bytes]) -> None:
        """Gather the object, then send it in one request, which fails if the key is taken."""
        from obstore.exceptions import AlreadyExistsError

        try:
            self._send(key, pieces, "create")
        except AlreadyExistsError as error:
            raise FileExistsError(f"results are written once: {key}") from error

    def replace(self, key: str, pieces: Iterable[bytes]) -> None:
        """Gather the object, then send it in one request."""
        self._send(key, pieces, "overwrite")

    def size(self, key: str) -> int:
        """Ask for the object's head."""
        import obstore

        with _answering(key):
            return int(obstore.head(self._store, key)["size"])

    def version(self, key: str) -> str | None:
        """Ask for the object's head, which has the digest of its bytes."""
        import obstore

        with suppress(FileNotFoundError), _answering(key):
            found = obstore.head(self._store, key)
            return f"{found['e_tag']}-{found['size']}-{found['last_modified'].timestamp()}"
        return None

    def read(self, key: str, start: int, stop: int) -> bytes:
        """Ask for a range; for one beyond the end, what there is of it."""
        import obstore

        if start < stop:
            with suppress(ConnectionError), _answering(key):
                return bytes(obstore.get_range(self._store, key, start=start, end=stop))
        stop = min(stop, self.size(key))
        if start >= stop:
            return b""
        with _answering(key):
            return bytes(obstore.get_range(self._store, key, start=start, end=stop))

    def entity_tag(self, key: str) -> str | None:
        """Ask for the object's head; of encrypted objects it may be no MD5."""
        import obstore

        with suppress(FileNotFoundError), _answering(key):
            return (obstore.head(self._store, key)["e_tag"] or "").strip('"') or None
        return None

    def list(self, prefix: str) -> Iterator[str]:
        """Ask for the keys in the folder that the prefix ends in."""
        import obstore

        folder = prefix.rpartition("/")[0]
        with _answering(prefix):
            for some in obstore.list(self._store, folder or None):
                yield from (one["path"] for one in some if one["path"].startswith(prefix))

    def cut_off(self, prefix: str) -> Iterator[str]:
        """Yield nothing: a request that was cut off leaves nothing."""
        return iter(())

    def remove(self, prefix: str) -> None:
        """Ask for the keys, and delete them together."""
        import obstore

        if found := [*self.list(prefix)]:
            with suppress(FileNotFoundError), _answering(prefix):
                obstore.delete(self._store, found)

    def adopt(self, key: str, lost: str) -> bool:
        """Have the store copy the object; what is copied at the same time has the same bytes."""
        import obstore

        if self.version(lost) is None:
            return False
        if self.version(key) is None:
            with _answering(lost):
                obstore.copy(self._store, lost, key)
        return True

    def link(self, key: str, endpoint: str, seconds: float) -> str | None:
        """Sign with the store's own credentials; it is not asked."""
        import obstore

        bucket, prefix, options = self._parts
        there = tuple(sorted((dict(options) | {"endpoint": endpoint}).items()))
        store = _opened((bucket, prefix, there), os.getpid())
        return str(obstore.sign(store, "GET", key, timedelta(seconds=seconds)))

    def link_to_put(self, key: str, endpoint: str, seconds: float, size: int) -> str | None:
        """Sign with the credentials in the environment, if they are there."""
        bucket, prefix, options = self._parts
        path = "/".join(filter(None, (bucket, prefix, key)))
        return address_to_put(endpoint, path, _region(dict(options)), seconds, size)

    def _send(
        self, key: str, pieces: Iterable[bytes], mode: Literal["create", "overwrite"]
    ) -> None:
        """Put an object; AlreadyExistsError where it is to be made and the key is taken."""
        import obstore
        from obstore.exceptions import AlreadyExistsError

        content = _gathered(pieces)
        if len(content) > self.largest:
            raise TooLarge(
                f"{key} would have {len(content) / 1e9:.3g} GB; an object of a bucket has at most"
                f" {self.largest / 1e9:g} GB"
            )
        if len(content) > _SHORT:
            from jointplay.storage.object_stores.sending import put_at

            with _answering(key):
                address = obstore.sign(self._store, "PUT", key, _SIGNED)
            put_at(address, key, content, once=mode == "create")
            return
        with _answering(key, AlreadyExistsError):
            obstore.put(self._store, key, content, mode=mode, use_multipart=False)

    @property
    def _store(self) -> "S3Store":
        return _opened(self._parts, os.getpid())  # its threads do not outlive a fork


@lru_cache(maxsize=8)
def _opened(parts: tuple[str, str, tuple[tuple[str, str], ...]], _process: int) -> "S3Store":
    from obstore.store import S3Store

    bucket, prefix, options = parts
    given = dict(options)
    return S3Store(
        bucket,
        prefix=prefix or None,
        endpoint=given.get("endpoint", os.environ.get("AWS_ENDPOINT_URL")),
        region=_region(given),
        virtual_hosted_style_request=False,
        client_options={"allow_http": True, "connect_timeout": "5s", "timeout": _LIMIT},
        retry_config=_RETRIES,
    )


def _region(given: Mapping[str, str]) -> str:
    return given.get("region", os.environ.get("AWS_REGION", "us-east-1"))


def _gathered(pieces: Iterable[bytes]) -> bytes | mmap.mmap:
    """Return all pieces as one: many bytes in a file without a name, which ends with its use."""
    pieces, memory = iter(pieces), BytesIO()
    for piece in pieces:
        memory.write(piece)
        if memory.tell() > _IN_MEMORY:
            break
    content = memory.getvalue()  # takes the bytes over, without a copy
    if len(content) <= _IN_MEMORY:
        return content
    with tempfile.TemporaryFile() as file:
        file.write(content)
        del content
        memory.close()
        file.writelines(pieces)
        file.flush()
        return mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)


@contextmanager
def _answering(key: str, *but: type[Exception]) -> Iterator[None]:
    """Raise what a folder would: FileNotFoundError, or ConnectionError if the store fails.

    Errors of the kinds `but` are the caller's.
    """
    from obstore.exceptions import BaseError, NotFoundError

    try:
        yield
    except but:
        raise
    except (NotFoundError, FileNotFoundError) as error:
        raise FileNotFoundError(f"{key} is not there") from error
    except BaseError as error:
        first = str(error).strip().partition("\n")[0]
        sentence = f"the store of results does not do as asked with {key}: {first}"
        raise ConnectionError(sentence) from error
