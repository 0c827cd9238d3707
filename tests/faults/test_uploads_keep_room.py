"""Files that workers send fill no disk: room is kept for them before they are on their way."""

import select
import socket
from base64 import b64encode
from collections.abc import Iterator
from contextlib import ExitStack
from hashlib import sha256
from pathlib import Path

import httpx
import pytest

from jointplay.service.workers import file_body
from jointplay.storage.settings import Settings
from jointplay.worker.joined.protocol import DropAt
from tests.backends import BACKENDS
from tests.joined_by_hand import NOT_HELD, REFUSED, SWING, Held, Installation, installation, said

MEGABYTE = 10**6


@pytest.fixture(params=BACKENDS)
def service(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Installation]:
    with installation(request.param, tmp_path_factory.mktemp("lab") / "data") as found:
        yield found


def begun(stack: ExitStack, held: Held, name: str, size: int) -> socket.socket:
    """Send the head of a PUT and the first bytes of its body."""
    url = httpx.URL(held.service.url)
    one = stack.enter_context(socket.create_connection((url.host, url.port), timeout=60.0))
    told = b64encode(sha256(b"never told").digest()).decode()
    head = f"PUT {held.path}/files/{name} HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: {size}\r\n"
    one.sendall(f"{head}Content-Digest: sha-256=:{told}:\r\n\r\nfirst".encode())
    return one


def answer_of(one: socket.socket) -> bytes:
    answer = b""
    while not answer.endswith(b"}"):
        answer += one.recv(65536)
    return answer


def test_room_is_kept_for_files_that_are_on_their_way(
    service: Installation, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Settings, "room", lambda _: 90 * MEGABYTE)
    service.submit(SWING)
    held = service.claim()
    with ExitStack() as stack:
        sockets = [begun(stack, held, f"a1/rows/{n}", 20 * MEGABYTE) for n in range(3)]
        answered, _, _ = select.select(sockets, [], [], 60.0)  # two have room, and wait for more
        assert len(answered) == 1
        refused = answer_of(answered[0])
        assert refused.startswith(b"HTTP/1.1 507")
        assert b"/problems/disk-full" in refused
    with ExitStack() as stack:  # what is not sent to its end keeps none
        begun(stack, held, "a1/rows/4", 20 * MEGABYTE)
        small = b"x" * MEGABYTE
        assert held.put("a1/rows/5", small).status_code == 204


def test_a_file_that_does_not_arrive_is_given_up(
    service: Installation, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(file_body, "PATIENCE", 0.2)
    monkeypatch.setattr(file_body, "SLOWEST", 1e9)
    service.submit(SWING)
    with ExitStack() as stack:
        answer = answer_of(begun(stack, service.claim(), "a1/rows/0", MEGABYTE))
        assert answer.startswith(b"HTTP/1.1 408")
        assert b"/problems/body-too-slow" in answer


def test_an_attempt_has_no_more_bytes_than_its_job_may_need(service: Installation) -> None:
    job = service.submit(SWING)
    held = service.claim()
    some = b"x" * (20 * MEGABYTE)
    answers = [held.put(f"a1/rows/{number}", some) for number in range(20)]
    taken = [one for one in answers if one.status_code == 204]
    assert 1 <= len(taken) < 10
    assert said(answers[len(taken)]) == REFUSED
    assert [*service.settings.running_files(job.id).names()] == []
    service.work()
    service.require_right(job)


def test_what_is_replaced_again_and_again_is_no_more_than_the_last_of_it(
    service: Installation,
) -> None:
    service.submit(SWING)
    held = service.claim()
    some = b"x" * (20 * MEGABYTE)
    assert {held.put("block0-a1", some).status_code for _ in range(10)} == {204}


@pytest.mark.long
def test_an_address_to_put_at_is_good_for_so_many_bytes(tmp_path: Path) -> None:
    with installation("bucket", tmp_path / "data", redirect=True) as service:
        job = service.submit(SWING)
        held = service.claim()
        content = b"x" * 1_500_000
        told = {"name": "a1/rows/0", "size": len(content)}
        told |= {"sha256": sha256(content).hexdigest(), "md5": "0" * 32}
        answer = service.http.post(f"{held.path}/drops", json=told)
        address = DropAt.model_validate_json(answer.content).address
        for other in (content + b"x", content[:-1], b""):
            assert httpx.put(address, content=other, trust_env=False).status_code == 403
        assert httpx.put(address, content=content, trust_env=False).is_success
        assert service.http.post(f"{held.path}/drops/taken", json=told).status_code == 204
        assert [*service.settings.running_files(job.id).names()] == ["a1/rows/0"]
        many = told | {"size": 10**9}
        assert said(service.http.post(f"{held.path}/drops", json=many)) == REFUSED


@pytest.mark.long
def test_addresses_are_given_for_no_more_than_a_job_may_need(tmp_path: Path) -> None:
    """Many may be asked for before anything is put."""
    with installation("bucket", tmp_path / "data", redirect=True) as service:
        service.submit(SWING)
        held = service.claim()
        told = {"name": "a1/rows/0", "size": 20 * MEGABYTE, "md5": "0" * 32}
        for digest in [*map("{:064x}".format, range(20))]:
            answer = service.http.post(f"{held.path}/drops", json=told | {"sha256": digest})
            again = service.http.post(f"{held.path}/drops", json=told | {"sha256": digest})
            if answer.is_error:
                break
            assert again.is_success
        assert said(answer) == REFUSED
        assert said(again) == NOT_HELD
