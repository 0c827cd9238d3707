"""Settings whose absence lost tasks or left workers deaf when they were measured."""

import ssl
import subprocess
import sys

import pytest
from kombu import Connection

from jointplay.worker.app import app, broker_url, make_app


def test_messages_are_acknowledged_early_and_never_prefetched() -> None:
    assert app.conf.task_acks_late is False
    assert app.conf.task_reject_on_worker_lost is False
    assert app.conf.worker_disable_prefetch is True
    assert app.conf.worker_prefetch_multiplier == 1


def test_a_silent_network_is_noticed() -> None:
    options = app.conf.broker_transport_options
    assert options["socket_timeout"] == 5
    assert options["health_check_interval"] == 10


def test_results_travel_through_the_catalogue_alone() -> None:
    assert app.conf.result_backend is None
    assert app.conf.task_ignore_result is True
    assert app.conf.accept_content == ["json"]


def test_a_socket_url_is_put_in_celerys_words() -> None:
    assert broker_url("unix:///run/redis.sock") == "redis+socket:///run/redis.sock"
    assert broker_url("redis://host:6379/0") == "redis://host:6379/0"


@pytest.mark.parametrize("more", ["", "?ssl_ca_certs=/etc/ca.pem"])
def test_certificates_of_the_broker_are_verified(more: str) -> None:
    connection = Connection(broker_url(f"rediss://:secret@host:6380/1{more}"))
    assert connection.ssl["ssl_cert_reqs"] is ssl.CERT_REQUIRED
    assert (connection.password, connection.virtual_host) == ("secret", "1")
    assert connection.ssl.get("ssl_ca_certs") == ("/etc/ca.pem" if more else None)
    unverified = "rediss://host/0?ssl_cert_reqs=none"
    assert broker_url(unverified) == unverified


def test_the_app_loads_no_task_code() -> None:
    loaded = "print(*(m in sys.modules for m in ('numba', 'jointplay.worker.tasks')))"
    script = f"import sys, jointplay.worker.app; {loaded}"
    ran = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert ran.stdout.split() == ["False", "False"]


class Enough(Exception):
    pass


def test_a_broker_that_is_away_for_long_is_asked_every_two_seconds() -> None:
    pauses: list[float] = []

    def note(_: Exception, pause: float) -> None:
        pauses.append(pause)
        if len(pauses) == 3:
            raise Enough

    connection = make_app("redis://127.0.0.1:1").connection_for_read()
    with pytest.raises(Enough):
        connection.ensure_connection(note, None)
    assert pauses == [2, 2, 2]
