"""Logs of a whole service as JSON: every line is an object, and says what it is about."""

import json
import sys
from contextlib import closing
from pathlib import Path
from typing import Any

import httpx
import pytest

from jointplay.service.processes import running_service
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.keys import id_in
from jointplay.storage.settings import Settings
from tests.waiting import until

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="needs a broker")
JOB = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}


def lines_of(data: Path, process: str) -> list[dict[str, Any]]:
    text = (data / "logs" / f"{process}.log").read_text()
    ours = text.replace("worker: Warm shutdown (MainProcess)", "")  # printed by Celery
    return [json.loads(line) for line in ours.splitlines() if line]


def test_lines_name_job_attempt_request_and_key(tmp_path: Path) -> None:
    with closing(Catalogue(Settings(data=tmp_path).catalogue_url)) as catalogue:
        catalogue.migrate()
        secret, _ = catalogue.make_key("ada", ["jobs:write", "jobs:read"], "", None)
    headers = {"Authorization": f"Bearer {secret}", "X-Request-Id": "a-proxy.1"}
    environment = {"JOINTPLAY_LOG_FORMAT": "json", "JOINTPLAY_KEYS": "required"}
    with (
        running_service(tmp_path, environment=environment) as url,
        httpx.Client(base_url=url, headers=headers, trust_env=False, timeout=60) as http,
    ):
        answer = http.post("/v1/jobs", json=JOB)
        assert answer.headers["X-Request-Id"] == "a-proxy.1"
        job = answer.json()["id"]
        until(lambda: http.get(f"/v1/jobs/{job}").json()["state"] == "succeeded")
        given = http.get("/v1/shared/a-secret/zarr", headers={"X-Request-Id": "not one"})
        assert given.headers["X-Request-Id"] != "not one"

    (ended,) = [line for line in lines_of(tmp_path, "worker") if line.get("job") == job]
    assert (ended["block"], ended["attempt"], ended["level"]) == (f"{job}-0", 1, "INFO")
    assert ended["logger"] == "jointplay.worker.block_run"
    assert any(line["logger"].startswith("celery.") for line in lines_of(tmp_path, "worker"))
    requests = [line for line in lines_of(tmp_path, "api") if "route" in line]
    sent = next(line for line in requests if line["method"] == "POST")
    assert (sent["route"], sent["status"], sent["request"]) == ("/v1/jobs", 202, "a-proxy.1")
    assert sent["key"] == id_in(secret)
    assert sent["seconds"] > 0.0
    looked = next(line for line in requests if line.get("job") == job)
    assert looked["route"] == "/v1/jobs/{job_id}"
    for log in (tmp_path / "logs").iterdir():
        assert secret not in log.read_text()
        assert "a-secret" not in log.read_text()
