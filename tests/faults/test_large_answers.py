"""Answers of a million values are made as they are taken: many at once take little memory."""

import socket
from contextlib import ExitStack
from pathlib import Path

import httpx
from jobs import IMPATIENT, api_of, catalogue_of, ended

from jointplay.service.processes import running_service
from jointplay.storage.catalogue.records import JobState
from jointplay.storage.packed import Packed
from jointplay.storage.settings import Settings
from tests.waiting import PATIENCE

LONG = {
    "kind": "simulate",
    "scene": {"preset": "slider-crank"},
    "duration": 30.0,
    "output_step": 1e-4,
    "channels": ["crank.x", "rod.x"],
    "certificate": False,
}
AT_ONCE = 24
MOST = 100.0  # MB that they take together; in one piece each takes 25


def highest(pid: int) -> float:
    """Return the most memory that a process has had [MB]."""
    (line,) = (
        line
        for line in Path(f"/proc/{pid}/status").read_text().splitlines()
        if line.startswith("VmHWM")
    )
    return int(line.split()[1]) / 1024.0


def test_many_large_answers_at_once_take_little_memory(tmp_path: Path) -> None:
    settings = Settings(data=tmp_path / "data")
    with (
        running_service(settings.data, environment=IMPATIENT) as url,
        catalogue_of(settings) as catalogue,
        httpx.Client(base_url=url, trust_env=False, timeout=PATIENCE) as http,
        ExitStack() as stack,
    ):
        job = http.post("/v1/jobs", json=LONG).json()["id"]
        assert ended(catalogue, job).state is JobState.succeeded
        path = f"/v1/jobs/{job}/history"
        narrow = http.get(path, params={"channels": "crank.x", "stop": 1.0}).json()
        (api,) = api_of(settings.data)
        before = highest(api)
        address = httpx.URL(url)
        held = []
        for _ in range(AT_ONCE):
            one = socket.create_connection((address.host, address.port), timeout=PATIENCE)
            held.append(stack.enter_context(one))
            one.sendall(f"GET {path} HTTP/1.1\r\nHost: {address.host}\r\n\r\n".encode())
        for one in held:  # each has begun
            assert one.recv(12) == b"HTTP/1.1 200"
        whole = http.get(path).json()
        assert highest(api) - before < MOST
        assert len(whole["time"]["values"]) == 300_001
        part = slice(len(narrow["time"]["values"]))
        assert whole["time"]["values"][part] == narrow["time"]["values"]
        assert (
            whole["channels"]["crank.x"]["values"][part]
            == (narrow["channels"]["crank.x"]["values"])
        )
        assert {**whole["channels"]["crank.x"], "values": 0} == (
            {**narrow["channels"]["crank.x"], "values": 0}
        )
        assert whole.keys() == narrow.keys()


def test_a_large_answer_of_damaged_results_is_refused_before_it_begins(tmp_path: Path) -> None:
    settings = Settings(data=tmp_path / "data")
    with (
        running_service(settings.data, environment=IMPATIENT) as url,
        catalogue_of(settings) as catalogue,
        httpx.Client(base_url=url, trust_env=False, timeout=PATIENCE) as http,
    ):
        job = http.post("/v1/jobs", json=LONG | {"duration": 4.0}).json()["id"]
        assert ended(catalogue, job).state is JobState.succeeded
        sealed = settings.sealed_run(job, 1)
        content = bytearray(sealed.read(0, sealed.size()))
        entries = Packed(sealed).entries
        last = max(key for key in entries if key.startswith("rod.x/c/"))
        content[entries[last].offset + 9] ^= 1
        sealed.object_store.replace(sealed.key, [bytes(content)])
        assert http.get(f"/v1/jobs/{job}/history").status_code == 410
