"""A balancer, and faults of the network and of the store, do what they say, without a service."""

import gc
import http.server
import os
import socket
import ssl
import subprocess
import sys
import tempfile
import threading
import time
from contextlib import suppress
from pathlib import Path

import httpx
from trustme import CA

from tests.machines.balancer import Balancer
from tests.machines.clock import COMPILER, Clock
from tests.machines.gate import Gate
from tests.machines.network import Port, make_bridge
from tests.machines.passing import certified

_TELL = "import sys, time\nfor _ in sys.stdin: print(time.time(), time.monotonic(), flush=True)"


class _Store(http.server.BaseHTTPRequestHandler):
    def do_PUT(self) -> None:
        content = self.rfile.read(int(self.headers["Content-Length"]))
        self.send_response(200)
        self.send_header("Content-Length", str(len(content)))
        self.end_headers()
        self.wfile.write(content[::-1])

    def log_message(self, *_: object) -> None:
        """Say nothing."""


def main() -> None:
    """Raise an AssertionError if they do not."""
    make_bridge()
    here, there = Port("here", 11), Port("there", 12)
    with there.inside():
        store = http.server.ThreadingHTTPServer((there.address, 0), _Store)
    threading.Thread(target=store.serve_forever, daemon=True).start()
    gate = Gate(there, store.server_port)
    with here.inside():
        assert _answer(gate.url) == b"cba"
        gate.refuse()
        while _answer(gate.url) == b"cba":  # it is told so in another thread
            pass
        assert _answer(gate.url) == 503
        gate.pass_on()
        assert _answer(gate.url) == b"cba"
    _try_balancer(there, store.server_port)
    if COMPILER is not None:
        _try_clock()
    here.pull_out()
    with here.inside():
        assert _reaches(there.address, store.server_port) == "refused at once"
    here.plug_in()
    there.leave()
    with here.inside():
        assert _reaches(there.address, store.server_port) == "silent"
    there.join()
    with here.inside():
        assert _answer(gate.url) == b"cba"


def _try_balancer(server: Port, number: int) -> None:
    """Ask one that knows a server that is absent, too, from where servers cannot be reached."""
    between, outside = Port("between", 13), Port("outside", 14)
    outside.forbid(server.address)
    absent = (server.address, 1)
    with tempfile.TemporaryDirectory() as folder, outside.inside():
        assert _reaches(server.address, number) == "refused at once"
        authority, file = CA(), Path(folder) / "authority.pem"
        authority.cert_pem.write_to_path(file)
        for known, expected in (
            ([absent, (server.address, number)], b"cba"),
            ([absent], 502),
        ):
            balancer = Balancer(between, known, certified(authority, between))
            trusted = ssl.create_default_context(cafile=file)
            assert [_answer(balancer.url, trusted) for _ in range(2)] == [expected, expected]
            assert _answer(balancer.url) is None  # its authority is unknown
        _try_early_end(between, server, authority)


def _try_early_end(between: Port, server: Port, authority: CA) -> None:
    """End an encrypted connection whose server says nothing: what passes it on still waits."""
    with server.inside():
        silent = socket.create_server((server.address, 0))
    port: int = silent.getsockname()[1]
    balancer = Balancer(between, [(server.address, port)], certified(authority, between))
    trusted = ssl.create_default_context()
    authority.configure_trust(trusted)
    address = httpx.URL(balancer.url)
    held = []
    for _ in range(2):  # with the second one, the end of the first has been seen to
        plain = socket.create_connection((address.host, address.port))
        with trusted.wrap_socket(plain, server_hostname=address.host) as client:
            client.sendall(b"abc")
            held.append(silent.accept()[0])
            client.unwrap().close()
        assert b"".join(iter(lambda: held[-1].recv(3), b"")) == b"abc"
    gc.collect()


def _try_clock() -> None:
    """Set the clock of a program while it runs: that of the system and no interval."""
    with tempfile.TemporaryDirectory() as folder:
        clock = Clock(Path(folder))
        told = subprocess.Popen(
            [sys.executable, "-c", _TELL],
            env=os.environ | clock.environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        assert told.stdin is not None
        assert told.stdout is not None
        for ahead in (0.0, 3600.0, -3600.0, 0.0):
            clock.set(ahead)
            told.stdin.write("\n")
            told.stdin.flush()
            seconds, interval = map(float, told.stdout.readline().split())
            assert abs(seconds - time.time() - ahead) < 600.0
            assert abs(interval - time.monotonic()) < 600.0
        told.stdin.close()
        told.wait()


def _answer(url: str, trusted: ssl.SSLContext | bool = True) -> bytes | int | None:
    with suppress(httpx.TransportError):
        answer = httpx.put(url, content=b"abc", verify=trusted, trust_env=False, timeout=30.0)
        return answer.content if answer.is_success else answer.status_code
    return None


def _reaches(address: str, port: int) -> str:
    try:
        socket.create_connection((address, port), timeout=0.3).close()
    except TimeoutError:
        return "silent"
    except OSError:
        return "refused at once"
    return "reached"


if __name__ == "__main__":
    main()
