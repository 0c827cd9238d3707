"""Whether faults of the network and of the store do what they say, without a service."""

import http.server
import socket
import threading
from contextlib import suppress

import httpx

from tests.machines.gate import Gate
from tests.machines.network import Port, make_bridge


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


def _answer(url: str) -> bytes | int | None:
    with suppress(httpx.TransportError):
        answer = httpx.put(url, content=b"abc", trust_env=False, timeout=30.0)
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
