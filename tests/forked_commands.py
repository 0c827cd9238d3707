"""The command `jointplay` in forks of a process that has imported all it needs.

Most of a short command is its start: two seconds of imports, the same each time.  Tests that run
many of them, and ask what they do rather than how they start, share one start.

`python -m tests.forked_commands FOLDER` makes FOLDER/jointplay, a program with the same arguments,
environment, folder, streams and exit code as the command itself, and serves it until it is ended.
"""

import importlib
import json
import os
import socket
import socketserver
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from jointplay.command_line import main

IMPORTED = (
    "jointplay.command_line.application",
    "jointplay.figures",
    "jointplay.local.folder_results",
    "jointplay.solver.lanes.bundle",
    "jointplay.local.running",
    "jointplay.worker.windows.evaluate",
    "matplotlib.backends.backend_agg",
    "matplotlib.figure",
    "pandas",
)
"""Modules that commands import."""
PROGRAM = """#!{python} -IS
import json, os, socket, sys
with socket.socket(socket.AF_UNIX) as server:
    server.connect({address!r})
    asked = json.dumps([sys.argv[1:], os.getcwd(), dict(os.environ)]).encode()
    socket.send_fds(server, [len(asked).to_bytes(4, "big")], [0, 1, 2])
    server.sendall(asked)
    answer = server.recv(1)
sys.exit(answer[0] if answer else "the command did not end by itself")
"""


@contextmanager
def forked_commands(folder: Path) -> Iterator[Path]:
    """Serve the command from a program in a new folder, which is given."""
    serving = [sys.executable, "-m", "tests.forked_commands", str(folder)]
    with subprocess.Popen(serving, stdout=subprocess.PIPE) as process:
        try:
            assert process.stdout is not None
            assert process.stdout.readline() == b"ready\n"
            yield folder
        finally:
            process.terminate()


class Command(socketserver.BaseRequestHandler):
    """One command, in its fork."""

    def handle(self) -> None:
        """Run it as its caller would, and answer with its exit code."""
        length, streams, _, _ = socket.recv_fds(self.request, 4, 3)
        asked = b""
        while len(asked) < int.from_bytes(length, "big"):
            asked += self.request.recv(1 << 16)
        arguments, folder, environment = json.loads(asked)
        for number, stream in enumerate(streams):
            os.dup2(stream, number)
            os.close(stream)
        os.chdir(folder)
        os.environ.clear()
        os.environ.update(environment)
        sys.argv = ["jointplay", *arguments]
        code = 1
        try:
            main()
        except SystemExit as ended:
            code = ended.code if isinstance(ended.code, int) else int(ended.code is not None)
        finally:
            sys.stdout.flush()
            sys.stderr.flush()
            self.request.sendall(bytes([code]))


class Commands(socketserver.ForkingMixIn, socketserver.UnixStreamServer):
    """Makes a fork for each command, until the process that started this one has ended."""

    caller = os.getppid()

    def service_actions(self) -> None:
        """Wait for forks that have ended; twice a second see whether the caller has."""
        super().service_actions()
        if os.getppid() != self.caller:
            raise SystemExit


def serve(folder: Path) -> None:
    """Write the program, and run a command in a fork whenever it asks for one."""
    for module in IMPORTED:
        importlib.import_module(module)
    folder.mkdir()
    address, program = str(folder / "socket"), folder / "jointplay"
    with Commands(address, Command) as commands:
        program.write_text(PROGRAM.format(python=sys.executable, address=address))
        program.chmod(0o755)
        sys.stdout.write("ready\n")
        sys.stdout.flush()
        commands.serve_forever()


if __name__ == "__main__":
    serve(Path(sys.argv[1]))
