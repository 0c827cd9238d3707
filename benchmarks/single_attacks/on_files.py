"""Damage to stored results and to the catalogue, and a second data folder."""

import subprocess
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from urllib.parse import urlsplit

import httpx
import psycopg

from benchmarks.single_attacks.attacked import SWING, Attacked
from jointplay.chaos.processes import end, running
from jointplay.service.processes import StartFailed, running_service
from jointplay.storage.object_stores import object_store_at

_DAMAGES = 24
_PATIENCE = 10.0  # s


@contextmanager
def small_disk(folder: Path, size: int) -> Iterator[None]:
    """Mount a file system of its own at a folder that is made."""
    folder.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", f"size={size}", "jointplay", str(folder)]
    subprocess.run(mount, check=True)
    try:
        yield
    finally:
        subprocess.run(["umount", "--lazy", str(folder)], check=True)


def _store(service: Attacked) -> tuple[bytes, Callable[[bytes], None]]:
    """Return the bytes of the largest stored file, and what replaces them."""
    if url := service.variables.get("JOINTPLAY_RESULTS_URL"):
        store = object_store_at(url)
        found = {key: store.read(key, 0, store.size(key)) for key in store.list("")}
        key = max(found, key=lambda one: len(found[one]))
        return found[key], lambda content: store.replace(key, [content])
    files = [path for path in (service.folder / "data/results").rglob("*") if path.is_file()]
    path = max(files, key=lambda one: one.stat().st_size)
    return path.read_bytes(), lambda content: void(path.write_bytes(content))


def void(_: object) -> None:
    """Return nothing."""


def damaged_store(service: Attacked) -> str:
    """Flip a byte of a stored run, here and there, and ask for the store."""
    job = service.submit(SWING)
    with service.joined():
        service.ended(job)
    whole, replace = _store(service)
    found: Counter[str] = Counter()
    with service.as_("bob") as bob:
        for number in range(_DAMAGES):
            at = (2 * number + 1) * len(whole) // (2 * _DAMAGES)
            replace(whole[:at] + bytes([whole[at] ^ 1]) + whole[at + 1 :])
            try:
                answer = bob.get(f"/v1/jobs/{job}/zarr.zip")
                sent = answer.status_code == 200 and answer.content != whole
                found["sent with 200" if sent else str(answer.status_code)] += 1
            except httpx.TransportError:
                found["cut off"] += 1
        replace(whole)
    return ", ".join(f"{count} {what}" for what, count in found.items()) + f" of {_DAMAGES}"


@contextmanager
def _unwritable(service: Attacked) -> Iterator[None]:
    """Let nobody write the catalogue: its files are immutable, or its database lets nobody in."""
    if url := service.variables.get("JOINTPLAY_CATALOGUE_URL"):
        server, _, name = url.rpartition("/")
        with psycopg.connect(f"{server}/postgres", autocommit=True) as connection:
            alter = f"ALTER DATABASE {name} ALLOW_CONNECTIONS ".encode()
            end = f"SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE datname = '{name}'"
            for value in (b"false", b"true"):
                connection.execute(alter + value)
                connection.execute(end.encode())
                if value == b"false":
                    yield
        return
    files = [str(path) for path in (service.folder / "data").glob("catalogue.sqlite*")]
    subprocess.run(["chattr", "+i", *files], check=True)
    try:
        yield
    finally:
        subprocess.run(["chattr", "-i", *files], check=True)


def catalogue(service: Attacked) -> str:
    """Submit jobs while the catalogue cannot be written."""
    statuses: Counter[str] = Counter()

    def submit() -> str:
        head = {"Authorization": f"Bearer {service.keys['bob']}"}
        try:
            answer = httpx.post(
                f"{service.url}/v1/jobs",
                json=SWING | {"cache": False},
                headers=head,
                timeout=_PATIENCE,
                trust_env=False,
            )
        except httpx.TimeoutException:
            return "hanging"
        except httpx.TransportError:
            return "cut off"
        return str(answer.status_code)

    submit()
    with _unwritable(service):
        for number in range(10):
            statuses[submit()] += 1
            if number == 4:  # it is started again meanwhile
                end(running(service.folder, "api"))
            time.sleep(0.5)
    begun = time.monotonic()
    while (after := submit()) != "202" and time.monotonic() - begun < 60.0:
        time.sleep(0.5)
    told = ", ".join(f"{count} {what}" for what, count in statuses.items())
    return f"{told}; afterwards {after}"


def second_folder(service: Attacked) -> str:
    """Start a service with another data folder, or bucket, on the same catalogue."""
    own = dict(service.variables)
    own.setdefault("JOINTPLAY_CATALOGUE_URL", f"sqlite:///{service.folder}/data/catalogue.sqlite")
    if url := own.get("JOINTPLAY_RESULTS_URL"):
        parts = urlsplit(url)
        own["JOINTPLAY_RESULTS_URL"] = parts._replace(path="/other").geturl()
    try:
        with running_service(service.folder / "second", 0, own) as url:
            return f"it starts, {httpx.get(f'{url}/readyz', trust_env=False).status_code}"
    except StartFailed:
        return "refused"
