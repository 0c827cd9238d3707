"""Running the service on one machine: broker, API, relay and workers under one supervisor."""

import ipaddress
import json
import logging
import sys
from pathlib import Path

from jointplay.service.processes.background import running_service
from jointplay.service.processes.child import StartFailed, WrongSetting
from jointplay.service.processes.supervisor import Supervisor

__all__ = ["StartFailed", "WrongSetting", "running_service", "serve"]


def serve(host: str, port: int, data: Path, workers: int, *, as_json: bool = False) -> None:
    """Run the service until SIGTERM or SIGINT; print its URL once it answers.

    Parameters
    ----------
    host, port
        Where the API listens; port 0 takes a free one.
    data
        Folder of everything it keeps; one service a folder.
    workers
        How many blocks are computed at a time.

    as_json
        Print a line of JSON with "url" and "data" instead of a sentence.

    Raises
    ------
    StartFailed
        It could not start; `WrongSetting` if other arguments or variables are needed.
    """
    logging.basicConfig(level=logging.WARNING, format="%(levelname)s: %(message)s")

    def announce(url: str) -> None:
        if as_json:
            sys.stdout.write(json.dumps({"url": url, "data": str(data)}) + "\n")
            sys.stdout.flush()
            return
        sys.stdout.write(f"jointplay is ready at {url} (data in {data}; Ctrl-C stops it)\n")
        if not _is_loopback(host):
            sys.stdout.write(
                "It listens beyond this machine and asks for no password: everyone who can reach"
                " it can run jobs and read all results.\n"
            )
        sys.stdout.flush()

    Supervisor(host, port, data, workers).run(announce)


def _is_loopback(host: str) -> bool:
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False
