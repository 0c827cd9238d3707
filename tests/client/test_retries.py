"""Requests that are repeated: what the service asks for, and what was lost on the way."""

import socket
import threading
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from datetime import UTC, datetime, timedelta
from email.utils import format_datetime
from functools import partial
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from inspect import signature

import httpx
import pytest

from jointplay.client import (
    AsyncClient,
    Client,
    NotAllowed,
    Overloaded,
    Refused,
    ServiceFailure,
    Unreachable,
    connection,
)
from jointplay.client.asynchronous.network import AwaitedNetwork
from jointplay.client.network import BlockingNetwork
from jointplay.service import prober, windows
from jointplay.service.scenes import checks

PENDULUM = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0, "cache": False}


@contextmanager
def front(answers, behind=None) -> Iterator[tuple[str, list]]:
    """A server that gives these answers first; what follows goes to the service behind it.

    An answer is a status with headers, and a body if it has one; "lost": the connection closes
    without one; "unheard": the service gets the request, and its answer is lost.
    """
    heard = []

    class Front(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"

        def answer(self):
            body = self.rfile.read(int(self.headers.get("content-length", 0)))
            heard.append((self.command, self.path, dict(self.headers)))
            first = answers.pop(0) if answers else None
            if first == "lost":
                self.close_connection = True
            elif isinstance(first, tuple):
                status, headers, *body = first
                self.reply(status, headers, *(body or [b""]))
            else:
                kept = {k: v for k, v in self.headers.items() if k.lower() != "host"}
                got = httpx.request(
                    self.command, behind + self.path, content=body, headers=kept, trust_env=False
                )
                if first == "unheard":
                    self.close_connection = True
                else:
                    self.reply(
                        got.status_code, {"Content-Type": got.headers["content-type"]}, got.content
                    )

        do_GET = do_POST = do_DELETE = answer  # noqa: N815

        def reply(self, status, headers, body):
            self.send_response(status)
            for name, value in {**headers, "Content-Length": str(len(body))}.items():
                self.send_header(name, value)
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, *arguments):
            pass

    with ThreadingHTTPServer(("127.0.0.1", 0), Front) as server:
        thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.01})
        thread.start()
        try:
            yield f"http://127.0.0.1:{server.server_port}", heard
        finally:
            server.shutdown()
            thread.join()


@pytest.fixture
def pauses(monkeypatch):
    """Seconds that the client would have waited."""
    seen = []

    def sleep(network, seconds):
        seen.append(seconds)

    for network in (BlockingNetwork, AwaitedNetwork):
        monkeypatch.setattr(network, "sleep", sleep)
    return seen


def number_of_jobs(url):
    return len(
        httpx.get(f"{url}/v1/jobs?page_size=1000", trust_env=False, timeout=60).json()["jobs"]
    )


PROBLEM = {"Content-Type": "application/problem+json"}
PAGE = {"Content-Type": "text/html"}


@pytest.mark.parametrize("page", [b"<html>", b"", b"[1]", b"\xff", b"[" * 100_000])
def test_a_page_in_place_of_an_answer_is_a_failure_of_the_service(connect, page):
    with front([(200, PAGE, page)] * 2) as (url, _), connect(url) as client:
        for ask in (client.jobs, lambda: client.submit(PENDULUM)):
            with pytest.raises(ServiceFailure, match="is no service of jointplay"):
                list(ask())


@pytest.mark.parametrize(
    "page", [b"<html>", b"[]", b"{}", b'{"errors": 3}', b'{"errors": [1, {}, {"detail": 2}]}']
)
@pytest.mark.parametrize(("status", "kind"), [(500, ServiceFailure), (422, Refused)])
def test_a_problem_that_is_none_is_still_an_error_of_its_status(connect, page, status, kind):
    with (
        front([(status, PROBLEM, page)]) as (url, _),
        connect(url) as client,
        pytest.raises(kind),
    ):
        client.submit(PENDULUM)


def test_a_job_is_waited_for_while_a_proxy_sends_a_page(connect, fresh_service, pauses):
    events = (200, {"Content-Type": "text/event-stream"}, b"event: progress\ndata: <html>\n\n")
    answers = []
    with front(answers, fresh_service) as (url, heard), connect(url) as client:
        job = client.submit(PENDULUM)
        cancel = partial(httpx.post, f"{fresh_service}/v1/jobs/{job.id}/cancel", trust_env=False)
        answers += [None, events, (200, PAGE, b"<html>"), events]
        job.wait(check=False, report=lambda _: cancel())
    assert job.state == "cancelled"
    assert len(heard) > 3  # once submitted, and asked past three pages


@pytest.mark.parametrize(
    "trouble",
    [
        "unheard",
        "lost",
        (503, {}),
        (507, {"Retry-After": "30"}),
        (429, {"Retry-After": "1"}),
        (409, {"Retry-After": "1"}),
    ],
)
def test_a_repeated_submission_queues_one_job(connect, fresh_service, pauses, trouble):
    with front([trouble, trouble], fresh_service) as (url, heard), connect(url) as client:
        job = client.submit(PENDULUM)
    assert job.state == "queued"
    assert number_of_jobs(fresh_service) == 1
    keys = [headers["Idempotency-Key"] for _, _, headers in heard]
    assert len(keys) == 3
    assert len(set(keys)) == 1
    assert len(pauses) == 2


def test_a_retry_whose_answer_was_lost_is_not_done_again_after_it_has_ended(
    connect, fresh_service, monkeypatch
):
    with Client(fresh_service) as other:

        def sleep(network, seconds):
            for job in other.jobs(state="queued"):
                job.cancel()  # meanwhile what was made has ended

        for network in (BlockingNetwork, AwaitedNetwork):
            monkeypatch.setattr(network, "sleep", sleep)
        failed = other.submit(PENDULUM).cancel()
        with front([None, "unheard"], fresh_service) as (url, _), connect(url) as client:
            again = client.job(failed.id).retry()
            assert again.state == "cancelled"
            assert number_of_jobs(fresh_service) == 2
            assert client.job(failed.id).retry().id != again.id  # which was another call


def test_every_submission_has_a_key_of_its_own(connect, fresh_service):
    with front([], fresh_service) as (url, heard), connect(url) as client:
        first, second = client.submit(PENDULUM), client.submit(PENDULUM)
        assert first.id != second.id
    assert len({headers["Idempotency-Key"] for _, _, headers in heard}) == 2


def test_a_deletion_whose_answer_was_lost_is_done(connect, fresh_service, pauses):
    with front([None, "unheard"], fresh_service) as (url, _), connect(fresh_service) as direct:
        job = direct.submit(PENDULUM).cancel()
        with connect(url) as client:
            client.job(job.id).delete()
    assert number_of_jobs(fresh_service) == 0


def test_what_the_service_asks_for_is_waited_and_a_little_more(connect, pauses):
    soon = format_datetime(datetime.now(UTC) + timedelta(seconds=9), usegmt=True)
    busy = [(503, {"Retry-After": "3"}), (429, {"Retry-After": soon}), (503, {}), (503, {})]
    busy.append((503, {"Retry-After": "5"}))
    with (
        front(busy) as (url, _),
        connect(url) as client,
        pytest.raises(Overloaded, match="503"),
    ):
        client.scenes()
    assert len(pauses) == connection.ATTEMPTS - 1
    first, date, third, fourth = pauses
    assert 3.0 < first < 3.2
    assert 7.0 < date < 9.2  # whole seconds in the header
    # no wish of the service: 0.1 s doubled from attempt to attempt, half of it by chance
    assert 0.2 <= third <= 0.4
    assert 0.4 <= fourth <= 0.8


def test_a_service_that_asks_for_too_much_patience_is_an_error(connect, pauses):
    with (
        front([(503, {"Retry-After": "3600"})]) as (url, _),
        connect(url) as client,
        pytest.raises(Overloaded),
    ):
        client.scenes()
    assert pauses == []


def test_nobody_there_is_looked_for_again_for_about_a_second(connect, pauses):
    with (
        connect("http://127.0.0.1:9") as client,
        pytest.raises(Unreachable, match="jointplay serve"),
    ):
        client.scenes()
    doubled = (0.1, 0.2, 0.4, 0.8)  # s, half by chance
    assert len(pauses) == len(doubled)
    for pause, longest in zip(pauses, doubled, strict=True):
        assert longest / 2 <= pause <= longest


def test_a_service_that_takes_no_connection_is_not_said_to_be_away(connect):
    """`start one with jointplay serve` was said, though it ran, and had too much to do."""
    with ExitStack() as stack:
        full = stack.enter_context(socket.create_server(("127.0.0.1", 0), backlog=1))
        with suppress(TimeoutError):
            while True:
                waiting = socket.create_connection(full.getsockname(), timeout=0.1)
                stack.callback(waiting.close)
        client = stack.enter_context(
            connect(f"http://127.0.0.1:{full.getsockname()[1]}", timeout=0.2)
        )
        with pytest.raises(Unreachable, match=r"took no connection in 0\.2 s; it is very busy"):
            client.scenes()


def test_a_service_that_stays_silent_is_said_to_be(connect):
    with socket.create_server(("127.0.0.1", 0)) as silent:  # takes connections, and says nothing
        url = f"http://127.0.0.1:{silent.getsockname()[1]}"
        with (
            connect(url, timeout=0.2) as client,
            pytest.raises(Unreachable, match=r"gave no answer in 0\.2 s"),
        ):
            client.scenes()


def test_clients_wait_longer_than_the_service_may_take():
    patience = max(windows._PATIENCE, prober._PATIENCE, checks._PATIENCE)
    for made in (Client, AsyncClient):
        assert signature(made).parameters["timeout"].default > patience


def test_other_refusals_are_not_repeated(connect, pauses):
    with front([(401, {}), (500, {})]) as (url, heard), connect(url) as client:
        with pytest.raises(NotAllowed):
            client.scenes()
        with pytest.raises(Exception, match="failed with 500"):
            client.scenes()
    assert (len(heard), pauses) == (2, [])


def test_the_api_key_is_sent_with_each_request(fresh_service, monkeypatch):
    with front([], fresh_service) as (url, heard), Client(url, key="sk_secret") as client:
        client.submit(PENDULUM).cancel()
        assert next(iter(client.jobs())).results.store().options == {
            "client_kwargs": {
                "headers": {"Authorization": "Bearer sk_secret"},
                "trust_env": False,
            }
        }
        monkeypatch.setenv("JOINTPLAY_KEY", "sk_other")
        monkeypatch.setenv("JOINTPLAY_URL", url)
        with Client() as other:
            other.scenes()
    sent = [headers["Authorization"] for _, _, headers in heard]
    assert sent == ["Bearer sk_secret"] * 3 + ["Bearer sk_other"]
