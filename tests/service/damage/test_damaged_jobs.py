"""A job whose results are damaged: what is answered, and how it is computed anew."""

import httpx
import pytest
import zarr

from jointplay.storage.packed import Packed
from jointplay.storage.places import StoredObject
from jointplay.storage.places.folder import Folder
from jointplay.storage.settings import Settings
from tests.worker_by_hand import Worker

# aiohttp leaves its connections to the garbage collector
pytestmark = pytest.mark.filterwarnings("ignore::ResourceWarning")


def test_a_damaged_job_is_computed_anew_when_it_is_submitted_again(
    http: httpx.Client, worker: Worker, settings: Settings
) -> None:
    job = worker.finished(label="to be damaged", duration=1.0)
    document = http.get(f"/v1/jobs/{job}").json()["job"]
    assert http.post("/v1/jobs", json=document).json()["id"] == job
    path = settings.data / "results" / settings.sealed_run(job, 1).key
    content = bytearray(path.read_bytes())
    content[-3] ^= 1
    path.write_bytes(content)
    answer = http.get(f"/v1/jobs/{job}/history")
    assert (answer.status_code, answer.headers["Cache-Control"]) == (410, "no-store")
    problem = answer.json()
    assert problem["type"] == "/problems/damaged-results"
    assert path.name in problem["detail"]
    assert "to /v1/jobs" in problem["detail"]
    shown = http.get(f"/v1/jobs/{job}").json()
    assert shown["state"] == "succeeded"
    assert path.name in shown["damaged"]
    again = http.post("/v1/jobs", json=document)
    assert again.status_code == 202
    assert again.json()["id"] != job


def test_stock_zarr_raises_and_shows_no_fill_values(
    service_url: str, worker: Worker, settings: Settings
) -> None:
    job = worker.finished(label="for zarr", duration=1.0)
    history = zarr.open_group(f"{service_url}/v1/jobs/{job}/zarr", mode="r")
    assert float(history["time"][-1]) == 1.0
    path = settings.data / "results" / settings.sealed_run(job, 1).key
    found = Packed(StoredObject(Folder(str(path.parent)), path.name)).entry("time/c/0")
    content = bytearray(path.read_bytes())
    content[found.offset + 7] ^= 1
    path.write_bytes(content)
    with pytest.raises(Exception, match="410"):
        history["time"][:]
    path.unlink()
    with pytest.raises(Exception, match="410"):
        history["slider7.x"][:]
