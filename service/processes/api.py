"""The HTTP process, with bounds on what clients may hold."""

import argparse
import gc
import socket
import sys

import uvicorn
from fastapi import FastAPI

from jointplay.records.log_lines import begin
from jointplay.service.access.first_key import require_key_beyond_this_machine
from jointplay.service.memory import keep_no_free_memory
from jointplay.service.processes.connections import protocol
from jointplay.service.processes.handshakes import EncryptedConfig
from jointplay.service.processes.refused_start import RefusedStart
from jointplay.storage.settings import Settings

LONGEST_HEAD = 256 * 1024
"""Bytes of a request's line and headers: 20 000 characters of a query, each of up to nine bytes."""
_TURN = 0.0005
"""Seconds after which a thread that computes lets another one go on: whoever answers a worker waits
for all of them, several times, and did so ten times as long with Python's own 0.005."""


def main() -> None:
    """Serve on an address, or on a listening socket inherited from the supervisor."""
    parser = argparse.ArgumentParser(prog="python -m jointplay.service.processes.api")
    parser.add_argument("--host", default="127.0.0.1")
    parser.add_argument("--port", type=int, default=8000)
    parser.add_argument("--fd", type=int, help="an inherited listening socket instead")
    parser.add_argument("--ssl-certfile", help="certificate with its chain: HTTPS only")
    parser.add_argument("--ssl-keyfile", help="its private key, if it is in another file")
    parser.add_argument(
        "--again", action="store_true", help="start also while the catalogue is out of reach"
    )
    arguments = parser.parse_args()
    keep_no_free_memory()
    sys.setswitchinterval(_TURN)
    begin(Settings().log_format)
    inherited = None if arguments.fd is None else [socket.socket(fileno=arguments.fd)]
    host = inherited[0].getsockname()[0] if inherited else arguments.host
    require_key_beyond_this_machine(host, again=arguments.again)
    encrypted = arguments.ssl_certfile or arguments.ssl_keyfile
    refused = RefusedStart()
    configuration = (EncryptedConfig if encrypted else uvicorn.Config)(
        lambda: refused.watched(_application(patient=arguments.again)),
        factory=True,
        host=arguments.host,
        port=arguments.port,
        ssl_certfile=arguments.ssl_certfile,
        ssl_keyfile=arguments.ssl_keyfile,
        access_log=False,  # clients poll; the log would say little else than `request_log` says
        log_config=None,  # its lines are written as ours are
        http=protocol(),
        ws="none",  # a connection that became another one would be in nobody's room
        timeout_keep_alive=30,
        timeout_graceful_shutdown=5,
        h11_max_incomplete_event_size=LONGEST_HEAD,
    )
    try:
        uvicorn.Server(configuration).run(sockets=inherited)
    except SystemExit as ended:  # it did not start
        sys.exit(refused.sentence or ended.code)


def _application(*, patient: bool) -> FastAPI:
    """Return the application; looking through what is loaded for garbage would halt all requests.

    That takes a tenth of a second, and finds nothing.
    """
    gc.disable()  # what is imported stays: looks through it are a sixth of the start
    from jointplay.service.app import create_app

    application = create_app(patient=patient)
    gc.enable()
    gc.collect()
    gc.freeze()
    return application


if __name__ == "__main__":
    main()
